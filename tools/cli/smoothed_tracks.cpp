#include "tools/cli/smoothed_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ghtrack::cli {

void write_smoothed_tracks(const std::filesystem::path& path,
                           std::span<const SmoothedSnapshot> history, TrackColumns more) {
  const Smoothed* next = nullptr;  // of the row that is written
  TrackColumns columns = more;
  columns.names.insert(columns.names.end(),
                       {"x_smooth", "y_smooth", "vx_smooth", "vy_smooth", "ax_smooth", "ay_smooth",
                        "sigma_x_smooth", "sigma_y_smooth"});
  columns.append = [&](CsvRow& row, const TrackEstimate& track) {
    if (more.append) more.append(row, track);
    const auto& [state, covariance] = *next++;
    row << state.position.x() << state.position.y() << state.velocity.x() << state.velocity.y()
        << state.acceleration.x() << state.acceleration.y()
        << std::sqrt(std::max(0.0, covariance(0, 0))) << std::sqrt(std::max(0.0, covariance(1, 1)));
  };
  TrackWriter writer(path, std::move(columns));
  for (const SmoothedSnapshot& now : history) {
    next = now.smoothed.data();
    writer.add(now.tracks);
  }
  writer.commit();
}

}  // namespace ghtrack::cli

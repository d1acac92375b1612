#include "tools/pipeline/box_tracking.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace ghtrack {
namespace {

/// A track where it was seen.
struct Sighting {
  std::int32_t frame;
  BoundingBox box;
  Eigen::Vector2d velocity;  // [pixel per frame]
  bool is_confirmed;
};

using Sightings = std::map<int, std::vector<Sighting>>;  // by id

MotRow row_of(std::int32_t frame, std::int64_t id, const BoundingBox& box) {
  const Eigen::Vector2d corner = box.top_left();
  return {.frame = frame,
          .id = id,
          .left = corner.x(),
          .top = corner.y(),
          .width = box.size.x(),
          .height = box.size.y()};
}

BoundingBox box_of(const MotRow& row) {
  const Eigen::Vector2d size(row.width, row.height);
  return {Eigen::Vector2d(row.left, row.top) + 0.5 * size, size};
}

/// The rows of one track: where it was seen, the gaps that are short enough, and where it may have
/// gone until the last frame of the sequence.
void append_rows(const BoxOutputConfig& output, std::int64_t id, std::int32_t last_frame,
                 std::span<const Sighting> sightings, std::vector<MotRow>& rows) {
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Sighting& now = sightings[i];
    if (i > 0) {
      const Sighting& last = sightings[i - 1];
      const std::int32_t step = now.frame - last.frame;
      for (std::int32_t k = 1; k < step && step - 1 <= output.longest_gap; ++k) {
        rows.push_back(
            row_of(last.frame + k, id, between(last.box, now.box, static_cast<double>(k) / step)));
      }
    }
    rows.push_back(row_of(now.frame, id, now.box));
  }
  const Sighting& last = sightings.back();
  for (std::int32_t k = 1; k <= std::min(output.coast, last_frame - last.frame); ++k) {
    rows.push_back(
        row_of(last.frame + k, id, {last.box.centre + k * last.velocity, last.box.size}));
  }
}

std::vector<MotRow> rows_of(const BoxOutputConfig& output, std::int32_t last_frame,
                            const Sightings& tracks) {
  std::vector<std::span<const Sighting>> confirmed;
  for (const auto& [id, sightings] : tracks) {
    const auto first = std::find_if(sightings.begin(), sightings.end(),
                                    [](const Sighting& seen) { return seen.is_confirmed; });
    if (first == sightings.end()) continue;
    confirmed.emplace_back(output.from_first_sight ? sightings.begin() : first, sightings.end());
  }
  std::stable_sort(confirmed.begin(), confirmed.end(),
                   [](const auto& a, const auto& b) { return a.front().frame < b.front().frame; });
  std::vector<MotRow> rows;
  for (std::size_t i = 0; i < confirmed.size(); ++i) {
    append_rows(output, static_cast<std::int64_t>(i) + 1, last_frame, confirmed[i], rows);
  }
  std::sort(rows.begin(), rows.end(), [](const MotRow& a, const MotRow& b) {
    return std::tie(a.frame, a.id) < std::tie(b.frame, b.id);
  });
  return rows;
}

}  // namespace

BoxTracks track_boxes(const BoxTrackerConfig& config, const BoxOutputConfig& output,
                      std::span<const MotRow> detections) {
  BoxTrackerState state;
  Sightings sightings;
  BoxScan scan;
  const auto finish_frame = [&] {
    state = step(config, std::move(state), scan);
    for (const BoxTrack& track : state.tracks) {
      if (!track.detection) continue;
      sightings[track.id].push_back({static_cast<std::int32_t>(scan.time), track.box,
                                     track.velocity, track.status != TrackStatus::kTentative});
    }
    scan.detections.clear();
  };
  for (std::size_t i = 0; i < detections.size(); ++i) {
    const MotRow& row = detections[i];
    scan.time = row.frame;
    scan.detections.push_back({box_of(row), row.confidence});
    const bool is_last = i + 1 == detections.size();
    if (is_last || detections[i + 1].frame != row.frame) finish_frame();
  }
  const std::int32_t last_frame = detections.empty() ? 0 : detections.back().frame;
  return {rows_of(output, last_frame, sightings), std::move(state)};
}

}  // namespace ghtrack

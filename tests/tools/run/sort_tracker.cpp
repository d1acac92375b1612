#include "tests/tools/run/sort_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "tracker/association.hpp"
#include "tracker/boxes/box.hpp"

namespace ghtrack {
namespace {

/// A Kalman filter for one quantity and its rate; all matrices of SORT are diagonal.
struct Axis {
  double x, v = 0.0;
  double xx = 10.0, xv = 0.0, vv = 1e4;

  void predict(double rate_noise) {
    x += v;
    xx += 2.0 * xv + vv + 1.0;
    xv += vv;
    vv += rate_noise;
  }
  void correct(double z, double noise) {
    const double gain = xx / (xx + noise), rate_gain = xv / (xx + noise), residual = z - x;
    x += gain * residual;
    v += rate_gain * residual;
    vv -= rate_gain * xv;
    xv *= 1.0 - gain;
    xx *= 1.0 - gain;
  }
};

struct SortTrack {
  explicit SortTrack(const BoundingBox& box)
      : x{box.centre.x()},
        y{box.centre.y()},
        area{box.area()},
        ratio(box.size.x() / box.size.y()) {}

  void predict() {
    if (area.x + area.v <= 0.0) area.v = 0.0;
    x.predict(0.01), y.predict(0.01), area.predict(0.0001);
    ratio_variance += 1.0;
    if (unseen > 0) streak = 0;
    ++unseen;
  }
  void correct(const BoundingBox& seen) {
    x.correct(seen.centre.x(), 1.0), y.correct(seen.centre.y(), 1.0);
    area.correct(seen.area(), 10.0);
    const double gain = ratio_variance / (ratio_variance + 10.0);
    ratio += gain * (seen.size.x() / seen.size.y() - ratio);
    ratio_variance *= 1.0 - gain;
    unseen = 0;
    ++streak;
  }
  BoundingBox box() const {
    const double width = std::sqrt(std::max(area.x * ratio, 1e-9));
    return {{x.x, y.x}, {width, std::max(area.x / width, 1e-9)}};
  }

  Axis x, y, area;
  double ratio, ratio_variance = 10.0;
  std::int64_t id = 0;
  int unseen = 0, streak = 0;
};

}  // namespace

std::vector<MotRow> track_by_sort(std::span<const MotRow> detections) {
  constexpr double kLeastOverlap = 0.3;
  std::vector<SortTrack> tracks;
  std::vector<MotRow> rows;
  std::int64_t next_id = 1;
  std::size_t next = 0;
  const std::int32_t last = detections.empty() ? 0 : detections.back().frame;
  for (std::int32_t frame = 1; frame <= last; ++frame) {
    std::vector<BoundingBox> seen;
    for (; next < detections.size() && detections[next].frame == frame; ++next) {
      const MotRow& row = detections[next];
      const Eigen::Vector2d size(row.width, row.height);
      seen.push_back({Eigen::Vector2d(row.left, row.top) + 0.5 * size, size});
    }
    CandidateTable table;
    for (SortTrack& track : tracks) {
      track.predict();
      for (std::size_t j = 0; j < seen.size(); ++j) {
        const double shared = overlap(track.box(), seen[j]);
        if (shared > 0.0) table.candidates.push_back({static_cast<int>(j), 1.0 - shared});
      }
      table.close_row();
    }
    const auto assigned = assign_globally(table, static_cast<int>(seen.size()), 1.0);
    std::vector<bool> is_used(seen.size(), false);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const int j = assigned[i];
      if (j == kMissed || overlap(tracks[i].box(), seen[j]) < kLeastOverlap) continue;
      tracks[i].correct(seen[j]);
      is_used[j] = true;
    }
    for (std::size_t j = 0; j < seen.size(); ++j) {
      if (is_used[j]) continue;
      tracks.emplace_back(seen[j]);
      tracks.back().id = next_id++;
    }
    for (const SortTrack& track : tracks) {
      if (track.unseen > 0 || (track.streak < 3 && frame > 3)) continue;
      const BoundingBox box = track.box();
      rows.push_back({.frame = frame,
                      .id = track.id,
                      .left = box.top_left().x(),
                      .top = box.top_left().y(),
                      .width = box.size.x(),
                      .height = box.size.y()});
    }
    std::erase_if(tracks, [](const SortTrack& track) { return track.unseen > 1; });
  }
  return rows;
}

}  // namespace ghtrack

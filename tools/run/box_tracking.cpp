#include "tools/run/box_tracking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace ghtrack {
namespace {

/// A track in one frame.
struct Sighting {
  std::int32_t frame;
  BoundingBox box;
  bool is_confirmed;
  bool is_predicted;  // from earlier frames; else seen in this one
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

/// The rows of one track. Where it was seen again soon enough, boxes in between replace those that
/// had been predicted.
void append_rows(std::int64_t id, int longest_gap, std::span<const Sighting> sightings,
                 std::vector<MotRow>& rows) {
  std::size_t next = 0;
  while (next < sightings.size()) {
    const Sighting& now = sightings[next];
    rows.push_back(row_of(now.frame, id, now.box));
    std::size_t again = next + 1;
    while (again < sightings.size() && sightings[again].is_predicted) ++again;
    const std::int32_t step = again < sightings.size() ? sightings[again].frame - now.frame : 0;
    if (now.is_predicted || step <= 1 || step - 1 > longest_gap) {
      ++next;
      continue;
    }
    for (std::int32_t k = 1; k < step; ++k) {
      const double fraction = static_cast<double>(k) / step;
      rows.push_back(row_of(now.frame + k, id, between(now.box, sightings[again].box, fraction)));
    }
    next = again;
  }
}

/// Whether a track was seen in most of the frames from its first to its last. What comes and goes
/// is often no object.
bool is_steady(std::span<const Sighting> sightings) {
  const auto seen = std::count_if(sightings.begin(), sightings.end(),
                                  [](const Sighting& now) { return !now.is_predicted; });
  return 2 * seen > sightings.back().frame - sightings.front().frame;
}

std::vector<MotRow> rows_of(const BoxOutputConfig& output, const Sightings& tracks) {
  const bool from_first_sight = output.from_first_sight.value_or(output.fill);
  std::vector<std::span<const Sighting>> confirmed;
  for (const auto& [id, sightings] : tracks) {
    const auto first = std::find_if(sightings.begin(), sightings.end(),
                                    [](const Sighting& seen) { return seen.is_confirmed; });
    if (first == sightings.end()) continue;
    confirmed.emplace_back(from_first_sight ? sightings.begin() : first, sightings.end());
  }
  std::stable_sort(confirmed.begin(), confirmed.end(),
                   [](const auto& a, const auto& b) { return a.front().frame < b.front().frame; });
  std::vector<MotRow> rows;
  for (std::size_t i = 0; i < confirmed.size(); ++i) {
    const bool fills = output.fill && is_steady(confirmed[i]);
    const int longest_gap = output.longest_gap.value_or(fills ? BoxOutputConfig::kLongestGap : 0);
    append_rows(static_cast<std::int64_t>(i) + 1, longest_gap, confirmed[i], rows);
  }
  std::sort(rows.begin(), rows.end(), [](const MotRow& a, const MotRow& b) {
    return std::tie(a.frame, a.id) < std::tie(b.frame, b.id);
  });
  return rows;
}

bool is_written(const BoxOutputConfig& output, const BoxTrack& track) {
  if (track.detection) return true;
  if (track.status != TrackStatus::kCoasting) return false;
  return output.coast ? track.unseen <= *output.coast : track.is_believed;
}

}  // namespace

BoxTracks track_boxes(const BoxTrackerConfig& config, const BoxOutputConfig& output,
                      std::span<const MotRow> detections) {
  BoxTrackerState state;
  Sightings sightings;
  BoxScan scan;
  const auto finish_frame = [&](std::int32_t frame) {
    scan.time = frame;
    state = step(config, std::move(state), scan);
    for (const BoxTrack& track : state.tracks) {
      if (!is_written(output, track)) continue;
      sightings[track.id].push_back({.frame = frame,
                                     .box = track.box,
                                     .is_confirmed = track.status != TrackStatus::kTentative,
                                     .is_predicted = !track.detection});
    }
    scan.detections.clear();
  };
  std::int32_t frame = detections.empty() ? 0 : detections.front().frame;
  for (const MotRow& row : detections) {
    while (frame < row.frame) {  // frames without a box have no rows
      finish_frame(frame++);
      if (state.tracks.empty()) frame = row.frame;
    }
    scan.detections.push_back({box_of(row), row.confidence});
  }
  if (!detections.empty()) finish_frame(frame);
  return {rows_of(output, sightings), std::move(state)};
}

std::string summary(const BoxTrackerConfig& config, std::span<const MotRow> detections,
                    const BoxTracks& tracks) {
  std::set<std::int32_t> images;
  for (const MotRow& row : detections) images.insert(row.frame);
  std::set<std::int64_t> ids;
  for (const MotRow& row : tracks.rows) ids.insert(row.id);
  const BoxLearning& learning = tracks.state.learning;
  const BoxNoise noise = box_noise(config, learning);
  const auto origin = [](bool is_given) { return is_given ? "given" : "learned"; };
  std::string line = fmt::format(
      "{} boxes in {} images, confidence {:.2f} ± {:.2f}; speed {:.3f} ({}) and its change {:.4f} "
      "({}) box scales per image; ",
      detections.size(), images.size(), learning.confidence.mean(), learning.confidence.deviation(),
      std::sqrt(noise.velocity), origin(config.initial_speed.has_value()),
      std::sqrt(noise.manoeuvre), origin(config.acceleration.has_value()));
  if (ids.empty()) {
    return line + fmt::format(
                      "no track was confirmed of {} begun: boxes.first_reach, .gate, "
                      ".start_confidence or .confirm_existence may be too strict",
                      tracks.state.next_id - 1);
  }
  return line +
         fmt::format("{} tracks confirmed of {} begun", ids.size(), tracks.state.next_id - 1);
}

}  // namespace ghtrack

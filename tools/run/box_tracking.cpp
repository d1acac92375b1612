#include "tools/run/box_tracking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

namespace ghtrack {
namespace {

/// A track in one frame.
struct Sighting {
  std::int32_t frame;
  BoundingBox box;
  bool is_predicted;  // from earlier frames; else seen in this one
};

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

/// Whether a track was seen in most of the frames from its first to its last. What comes and goes
/// is often no object.
bool is_steady(std::span<const Sighting> sightings) {
  const auto seen = std::count_if(sightings.begin(), sightings.end(),
                                  [](const Sighting& now) { return !now.is_predicted; });
  return 2 * seen > sightings.back().frame - sightings.front().frame;
}

bool is_written(const BoxOutputConfig& output, const BoxTrack& track) {
  if (track.detection) return true;
  if (track.status != TrackStatus::kCoasting) return false;
  return output.coast ? track.unseen <= *output.coast : track.is_believed;
}

/// Hands on the boxes of tracks frame by frame, as soon as nothing that comes can change them.
class BoxOutput {
 public:
  using OnRows = std::function<void(std::span<const MotRow>)>;

  BoxOutput(const BoxOutputConfig& config, const OnRows& on_rows)
      : config_(config),
        from_first_sight_(config.from_first_sight.value_or(config.fill)),
        waits_for_end_(config.fill && !config.longest_gap),
        on_rows_(on_rows) {}

  /// @param tracks  all that go on after this frame
  void add(std::int32_t frame, std::span<const BoxTrack> tracks) {
    frame_ = frame;
    for (const BoxTrack& track : tracks) {
      Track& own = tracks_[track.id];
      own.frame = frame;
      if (!is_written(config_, track)) continue;
      own.is_confirmed = own.is_confirmed || track.status != TrackStatus::kTentative;
      if (!own.is_confirmed && !from_first_sight_) continue;
      own.open.push_back({.frame = frame, .box = track.box, .is_predicted = !track.detection});
    }
    std::int32_t first_open = frame + 1;
    for (auto entry = tracks_.begin(); entry != tracks_.end();) {
      auto& [id, track] = *entry;
      const bool is_over = track.frame != frame;
      settle(id, track, is_over);
      if (!track.open.empty()) first_open = std::min(first_open, track.open.front().frame);
      entry = is_over ? tracks_.erase(entry) : std::next(entry);
    }
    hand_on(first_open);
  }

  void finish() {
    for (auto& [id, track] : tracks_) settle(id, track, true);
    tracks_.clear();
    hand_on(std::numeric_limits<std::int32_t>::max());
  }

  std::int64_t tracks() const { return static_cast<std::int64_t>(numbers_.size()); }

 private:
  /// A track that goes on.
  struct Track {
    std::int32_t frame = 0;  // the last of it
    bool is_confirmed = false;
    std::vector<Sighting> open = {};  // that may still be changed
  };

  /// Makes rows of what cannot change any more. Where a track was seen again soon enough, boxes in
  /// between replace those that had been predicted.
  void settle(int id, Track& track, bool is_over) {
    std::vector<Sighting>& open = track.open;
    if (is_over && !track.is_confirmed) open.clear();
    const bool may_change = !is_over && (waits_for_end_ || !track.is_confirmed);
    if (open.empty() || may_change) return;
    const bool fills = config_.fill && is_steady(open);
    const int longest_gap = config_.longest_gap.value_or(fills ? BoxOutputConfig::kLongestGap : 0);
    std::size_t next = 0;
    while (next < open.size()) {
      const Sighting& now = open[next];
      std::size_t again = next + 1;
      while (again < open.size() && open[again].is_predicted) ++again;
      const bool is_last = again == open.size();
      const std::int32_t gap = (is_last ? frame_ + 1 : open[again].frame) - now.frame - 1;
      const bool closes = !now.is_predicted && gap <= longest_gap;
      if (closes && is_last && !is_over && longest_gap > 0) break;
      add_row(id, now.frame, now.box);
      if (!closes || is_last) {
        ++next;
        continue;
      }
      for (std::int32_t k = 1; k <= gap; ++k) {
        const double fraction = static_cast<double>(k) / (gap + 1);
        add_row(id, now.frame + k, between(now.box, open[again].box, fraction));
      }
      next = again;
    }
    open.erase(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(next));
  }

  void add_row(int id, std::int32_t frame, const BoundingBox& box) {
    settled_[frame].push_back(row_of(frame, id, box));
  }

  /// Hands on the frames before one. Tracks get their numbers when they appear.
  void hand_on(std::int32_t end) {
    while (!settled_.empty() && settled_.begin()->first < end) {
      std::vector<MotRow>& rows = settled_.begin()->second;
      std::ranges::sort(rows, {}, &MotRow::id);
      for (MotRow& row : rows) {
        const auto next = static_cast<std::int64_t>(numbers_.size()) + 1;
        row.id = numbers_.try_emplace(row.id, next).first->second;
      }
      std::ranges::sort(rows, {}, &MotRow::id);
      on_rows_(rows);
      settled_.erase(settled_.begin());
    }
  }

  BoxOutputConfig config_;
  bool from_first_sight_;
  bool waits_for_end_;
  const OnRows& on_rows_;
  std::int32_t frame_ = 0;                                  // the latest
  std::map<int, Track> tracks_;                             // that go on, by the tracker's ids
  std::map<std::int32_t, std::vector<MotRow>> settled_;     // by frame, with the tracker's ids
  std::unordered_map<std::int64_t, std::int64_t> numbers_;  // of tracks in the output
};

}  // namespace

BoxTracking track_boxes(const BoxTrackerConfig& config, const BoxOutputConfig& output,
                        const BoxSource& detections,
                        const std::function<void(std::span<const MotRow>)>& on_rows) {
  BoxTracking result;
  BoxTrackerState& state = result.state;
  BoxOutput out(output, on_rows);
  BoxScan scan;
  std::int32_t frame = 0;
  const auto finish_frame = [&] {
    scan.time = frame;
    state = step(config, std::move(state), scan);
    out.add(frame, state.tracks);
    scan.detections.clear();
  };
  for (auto rows = detections(); !rows.empty(); rows = detections()) {
    const std::int32_t next = rows.front().frame;
    if (result.images > 0) ++frame;
    while (!state.tracks.empty() && frame < next) {  // frames without a box have no rows
      finish_frame();
      ++frame;
    }
    frame = next;
    for (const MotRow& row : rows) scan.detections.push_back({box_of(row), row.confidence});
    finish_frame();
    ++result.images;
    result.boxes += static_cast<std::int64_t>(rows.size());
    result.last_frame = frame;
  }
  out.finish();
  result.tracks = out.tracks();
  return result;
}

BoxTracks track_boxes(const BoxTrackerConfig& config, const BoxOutputConfig& output,
                      std::span<const MotRow> detections) {
  BoxTracks result;
  static_cast<BoxTracking&>(result) =
      track_boxes(config, output, frames_of(detections), [&](std::span<const MotRow> rows) {
        result.rows.insert(result.rows.end(), rows.begin(), rows.end());
      });
  return result;
}

std::string summary(const BoxTrackerConfig& config, const BoxTracking& tracking) {
  const BoxLearning& learning = tracking.state.learning;
  const BoxNoise noise = box_noise(config, learning);
  const auto origin = [](bool is_given) { return is_given ? "given" : "learned"; };
  std::string line = fmt::format(
      "{} boxes in {} images, confidence {:.2f} ± {:.2f}; usual error of their sizes {:.3f} "
      "(learned); speed {:.3f} ({}) and its change {:.4f} ({}) box scales per image; ",
      tracking.boxes, tracking.images, learning.confidence.mean(), learning.confidence.deviation(),
      std::sqrt(noise.usual * noise.size), std::sqrt(noise.velocity),
      origin(config.initial_speed.has_value()), std::sqrt(noise.manoeuvre),
      origin(config.acceleration.has_value()));
  if (tracking.tracks == 0) {
    return line + fmt::format(
                      "no track was confirmed of {} begun: boxes.first_reach, .gate, "
                      ".start_confidence or .confirm_existence may be too strict",
                      tracking.state.next_id - 1);
  }
  return line + fmt::format("{} {} confirmed of {} begun", tracking.tracks,
                            tracking.tracks == 1 ? "track" : "tracks", tracking.state.next_id - 1);
}

}  // namespace ghtrack

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/record/mot_file.hpp"
#include "tracker/boxes/box_tracker.hpp"

namespace ghtrack {

/// What is written of the tracks of a sequence. By default each row follows from its image and
/// those before, as if it had been written then.
struct BoxOutputConfig {
  static constexpr std::string_view about = "which boxes are written for the tracks of a sequence";

  bool fill = false;
  std::optional<bool> from_first_sight = {};
  std::optional<int> longest_gap = {};
  std::optional<int> coast = {};

  /// With `fill`, gaps up to this are closed where nothing else is said.
  static constexpr int kLongestGap = 30;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("fill", &BoxOutputConfig::fill,
            {.meaning = "what was known later is written as well: the boxes of a track from before "
                        "it was confirmed, and, if it was seen in most of its images, boxes in "
                        "between where it was not for up to 30; the output is then no longer "
                        "causal"});
    v.field("from_first_sight", &BoxOutputConfig::from_first_sight,
            {.meaning = "once a track is confirmed, its boxes from before are written too; by "
                        "default as `fill` says"});
    v.field("longest_gap", &BoxOutputConfig::longest_gap,
            {.meaning = "images without a detection that are filled with boxes in between when the "
                        "track has been seen again; 0: none; by default as `fill` says",
             .minimum = 0,
             .maximum = 1e6});
    v.field("coast", &BoxOutputConfig::coast,
            {.meaning = "images after a detection of a track for which its predicted box is "
                        "written; by default as many as predictions have come true for more often "
                        "than not so far",
             .minimum = 0,
             .maximum = 1e6});
  }
};

/// What tracking a sequence came to.
struct BoxTracking {
  std::int64_t boxes = 0;       // that were read
  std::int64_t images = 0;      // that had some
  std::int32_t last_frame = 1;  // of them
  std::int64_t tracks = 0;      // that were confirmed
  BoxTrackerState state;  // at the end, with what was learned and the counts of what was refused
};

/// Tracks the boxes of a sequence. Rows are handed on as soon as nothing that comes can change
/// them: at once by default; with `longest_gap` so many images later; with `from_first_sight` when
/// the tracks that began before are confirmed or given up; with `fill` when those are over. Until
/// then they are held in memory.
/// @param on_rows  gets the rows of one frame after the other, each by id; ids count from 1 in the
/// order of appearance
BoxTracking track_boxes(const BoxTrackerConfig& config, const BoxOutputConfig& output,
                        const BoxSource& detections,
                        const std::function<void(std::span<const MotRow>)>& on_rows);

/// The tracks of a sequence in memory.
struct BoxTracks : BoxTracking {
  std::vector<MotRow> rows;  // by frame, then id
};

/// Tracks the boxes of a sequence in memory.
/// @param detections  by frame
BoxTracks track_boxes(const BoxTrackerConfig& config, const BoxOutputConfig& output,
                      std::span<const MotRow> detections);

/// One line for people: what was read, what the filters assumed in the end, what came out.
std::string summary(const BoxTrackerConfig& config, const BoxTracking& tracking);

}  // namespace ghtrack

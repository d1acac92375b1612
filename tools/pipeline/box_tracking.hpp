#pragma once

#include <span>
#include <vector>

#include "tools/record/mot_file.hpp"
#include "tracker/boxes/box_tracker.hpp"

namespace ghtrack {

/// What is written of the tracks of a whole sequence, which is known to its end before a row of it
/// is needed.
struct BoxOutputConfig {
  static constexpr std::string_view about = "which boxes are written for the tracks of a sequence";

  bool from_first_sight = true;
  int longest_gap = 8;
  int coast = 0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("from_first_sight", &BoxOutputConfig::from_first_sight,
            {.meaning = "once a track is confirmed, its boxes from before are written too"});
    v.field("longest_gap", &BoxOutputConfig::longest_gap,
            {.meaning = "images without a detection that are filled with boxes in between when the "
                        "track has been seen again; 0: none",
             .minimum = 0,
             .maximum = 1e6});
    v.field("coast", &BoxOutputConfig::coast,
            {.meaning = "images after the last detection of a track for which its predicted box is "
                        "written",
             .minimum = 0,
             .maximum = 1e6});
  }
};

/// The tracks of a sequence of boxes.
struct BoxTracks {
  std::vector<MotRow> rows;  // by frame, then id; ids count from 1 in the order of appearance
  BoxTrackerState state;     // at the end, with the counts of what was refused
};

/// Tracks the boxes of a sequence.
/// @param detections  by frame
BoxTracks track_boxes(const BoxTrackerConfig& config, const BoxOutputConfig& output,
                      std::span<const MotRow> detections);

}  // namespace ghtrack

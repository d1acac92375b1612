#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {

/// How the scans of one sensor came in.
struct ArrivalCounts {
  std::int64_t in_order = 0;
  std::int64_t replayed = 0;  // late, and worked in where they belong
  std::int64_t refused = 0;   // late, and too late or not wanted; or without a finite time
};

/// A scan that may have to be processed again, and the tracker before it.
struct Replayable {
  TrackerState before;
  Scan scan;
  std::vector<int> identities;
};

/// A tracker that copes with scans in the order of their arrival. A value, as TrackerState is.
struct ReplayState {
  TrackerState now;
  std::vector<Replayable> past;         // inside the window, by time and sensor
  std::vector<ArrivalCounts> arrivals;  // by Scan::sensor
};

/// Processes one scan, late or not. A scan is late if the tracker has seen one of a later time, or
/// of the same time and a later sensor. With `late_scans: replay` a late scan inside the window is
/// put where it belongs and everything after it is processed again: the state becomes exactly that
/// of a tracker which got all scans in the order of time and sensor. With `late_scans: refuse`, and
/// beyond the window, a scan from before the latest one is refused and counted.
///
/// Replaying keeps one TrackerState for every scan inside the window.
ReplayState step(const TrackerDesign& design, ReplayState state, const Scan& scan,
                 std::span<const int> identities = {});

/// Whether this scan is the latest that the tracker has processed: false for one that was late.
inline bool has_processed_last(const ReplayState& state, const Scan& scan) {
  return state.now.time == scan.time && state.now.sensor == scan.sensor;
}

}  // namespace ghtrack

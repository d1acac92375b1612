#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "sensors/observation.hpp"
#include "tracker/replay.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {

// `association: known`, as in the textbook's experiments: every detection goes to the track of the
// object that made it, and clutter to none. The tracker knows nothing of this: each object has one
// of its own, which is shown the detections of that object alone.

/// What the trackers of all objects remember. A value, as TrackerState is.
struct KnownState {
  double time = -std::numeric_limits<double>::infinity();  // of the latest scan [s]
  int sensor = 0;                                          // of the latest scan
  ScanFate fate = ScanFate::kProcessed;                    // of the latest scan that it was given
  int next_id = 1;
  std::map<ObjectId, TrackerState> trackers;  // of the objects that have a track
  std::int64_t detections_refused = 0;        // without a finite position and covariance
};

/// The tracker of one object: it takes what it is shown, however far off, and counts hits and
/// misses.
/// @throws std::invalid_argument if a filter cannot be designed
TrackerDesign design_for_one_object(TrackerConfig config, std::vector<SensorTraits> sensors);

/// Processes one scan: TrackerState step(…) for each object.
/// @param design  for one object
KnownState step(const TrackerDesign& design, KnownState state, const Observation& observation);

/// What the trackers say after the latest scan, in the order of birth.
TrackSnapshot snapshot(const KnownState& state);

/// A tracker with known association that copes with late scans.
inline const Scan& scan_of(const Observation& observation) { return observation.scan; }
using KnownReplayState = Replaying<KnownState, Observation>;

}  // namespace ghtrack

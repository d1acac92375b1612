#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/arrival.hpp"
#include "tracker/existence.hpp"
#include "tracker/hypotheses.hpp"
#include "tracker/step_times.hpp"
#include "tracker/track.hpp"
#include "tracker/track_state.hpp"
#include "tracker/tracker_design.hpp"

namespace ghtrack {

/// Everything that a tracker remembers. A value: copies run on independently.
struct TrackerState {
  double time = -std::numeric_limits<double>::infinity();  // of the latest scan [s]
  int sensor = 0;                                          // of the latest scan
  ScanFate fate = ScanFate::kProcessed;                    // of the latest scan that it was given
  bool weighs_existence = false;                           // life_cycle: existence
  int next_id = 1;
  int next_birth = 1;                   // of tracks that are not confirmed yet
  std::vector<Track> tracks;            // in the order of birth; of the likeliest hypothesis
  Undetected undetected;                // life_cycle: existence
  std::vector<TrackCluster> clusters;   // association: multi-scan
  std::int64_t scans_refused = 0;       // older than the latest scan, or without a finite time
  std::int64_t detections_refused = 0;  // without a finite position and covariance

  /// ln p of the latest scan given all before it, as the tracker's assumptions have it: how well
  /// they fit the data. Detections as a Poisson process of false ones and unknown targets, each
  /// track with its existence; 0 where hits are counted.
  double log_likelihood = 0.0;
};

/// Processes one scan.
///   predict     every track to the time of the scan
///   associate   find out which detections may be whose
///   update      tracks with their detections; tracks without one coast
///   life cycle  confirm and drop tracks, by existence or by counts; merge tracks of one target;
///               each leftover detection starts a track
/// A scan that is older than the latest one, and a detection that is not usable, is refused and
/// counted. A miss counts only where and when the sensor could have seen the target.
/// @param times  where to add the time of each stage; the result does not depend on it
TrackerState step(const TrackerDesign& design, TrackerState state, const Scan& scan,
                  StepTimes* times = nullptr);

/// What the tracker says after its latest scan.
TrackSnapshot snapshot(const TrackerState& state);

}  // namespace ghtrack

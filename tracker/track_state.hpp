#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "sensors/detection.hpp"
#include "tracker/filters/filter.hpp"
#include "tracker/hit_history.hpp"
#include "tracker/nearest_tree.hpp"
#include "tracker/prediction.hpp"
#include "tracker/track.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// One hypothesis of a target.
struct Track {
  int id = 0;     // with `life_cycle: existence` negative until confirmed
  int birth = 0;  // counts from 1 in the order of birth
  TrackStatus status = TrackStatus::kTentative;
  std::optional<double> existence;  // probability that there is a target; absent: not weighed
  int unseen = 0;                   // looks since its last detection
  double seen_at = 0.0;             // time of its last detection [s]
  int rival = 0;                    // an older track that may follow the same target
  int shared = 0;                   // scans in which the two had one detection between them
  HitHistory history;
  std::optional<std::size_t> detection;  // of this scan
  Filter filter;
  std::string label;                                                // of the first detection
  Prediction prediction;                                            // of this scan's detection
  Eigen::Matrix2d innovation_covariance = Eigen::Matrix2d::Zero();  // of this scan's residual [m²]
  std::optional<Eigen::Vector2d> residual;                          // of this scan's detection
};

/// Carries a track dt seconds on.
void predict(Track& track, double dt);

/// How far its next detection may lie: as the mode that knows least says, where several are mixed.
Prediction reach(const Track& track);

/// Starts a track at a detection.
/// @param filter  waits for its first measurement
Track begin_track(const Filter& filter, const Scan& scan, std::size_t detection);

/// How unlikely a detection in the reach of a track is if it is the track's own: −ln of its density
/// times 2 π m².
double surprise(const Track& track, const Gated& gated, const PlacedDetection& detection);

/// Gives the track the detection that is its own.
void hit(Track& track, const PlacedDetection& found, const Scan& scan);

/// A detection that may be the track's own, and the probability that it is.
struct Weighted {
  const PlacedDetection* detection;
  double probability;
};

/// Lets the track be pulled by several detections, one of which at most is its own: to the moments
/// of the mixture that updating with each of them, and with none, would give.
/// @param probable  of probabilities that sum up to at most 1; not empty
void pull(Track& track, std::span<const Weighted> probable);

/// Says that this detection, among those that pulled, is taken for the track's own.
void note_detection(Track& track, const PlacedDetection& found, double time);

/// Should this scan have shown the track's target? Where the sensor sees, and with partial scans
/// when it is time for the next look at the place. Below the floor nothing hides: whoever is
/// expected there, and farther below than the gate reaches, would be somewhere else and seen.
bool is_due(const Track& track, const TrackerConfig& config, const SensorTraits& sensor,
            double time);

/// The track has no detection in a scan. It counts as missed if it was due.
void miss(Track& track, const TrackerConfig& config, const SensorTraits& sensor, double time);

}  // namespace ghtrack

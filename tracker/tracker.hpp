#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/arrival.hpp"
#include "tracker/filters/filter.hpp"
#include "tracker/gate.hpp"
#include "tracker/hit_history.hpp"
#include "tracker/step_times.hpp"
#include "tracker/track.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// One hypothesis of a target.
struct Track {
  int id = 0;
  TrackStatus status = TrackStatus::kTentative;
  int unseen = 0;  // scans since its last detection
  int rival = 0;   // an older track that may follow the same target
  int shared = 0;  // scans in which the two had one detection between them
  HitHistory history;
  std::optional<std::size_t> detection;  // of this scan
  Filter filter;
  std::string label;                                                // of the first detection
  Prediction prediction;                                            // of this scan's detection
  Eigen::Matrix2d innovation_covariance = Eigen::Matrix2d::Zero();  // of this scan's residual [m²]
  std::optional<Eigen::Vector2d> residual;                          // of this scan's detection
};

/// Everything that a tracker remembers. A value: copies run on independently.
struct TrackerState {
  double time = -std::numeric_limits<double>::infinity();  // of the latest scan [s]
  int sensor = 0;                                          // of the latest scan
  ScanFate fate = ScanFate::kProcessed;                    // of the latest scan that it was given
  int next_id = 1;
  std::vector<Track> tracks;            // in the order of birth
  std::int64_t scans_refused = 0;       // older than the latest scan, or without a finite time
  std::int64_t detections_refused = 0;  // without a finite position and covariance
};

/// A tracker for given sensors: its configuration, and a filter designed for each class and sensor.
/// Without a filter named "default", those of all classes run side by side where no class is told.
class TrackerDesign {
 public:
  /// @param sensors  the data sheets, by Scan::sensor
  /// @throws std::invalid_argument if a filter cannot be designed, such as for unstable gains, or
  ///         the association is `known`: who knows it decorates a tracker that does not
  TrackerDesign(TrackerConfig config, std::vector<SensorTraits> sensors);

  const TrackerConfig& config() const { return config_; }
  const SensorTraits& sensor(int index) const {
    return sensors_.at(static_cast<std::size_t>(index));
  }

  /// The filter of a new track: waits for its first measurement.
  const Filter& filter_for(std::string_view label, int sensor) const;

 private:
  using FiltersByLabel = std::map<std::string, Filter, std::less<>>;

  TrackerConfig config_;
  std::vector<SensorTraits> sensors_;
  std::vector<FiltersByLabel> filters_;  // of each sensor
};

/// Processes one scan.
///   predict     every track to the time of the scan
///   associate   gate and assign: confirmed tracks first, tentative ones get what is left
///   update      tracks with their detection; tracks without one coast
///   life cycle  confirm and drop by the hit and miss rules; merge tracks of one target; each
///               leftover detection starts a track
/// A scan that is older than the latest one, and a detection that is not usable, is refused and
/// counted. A miss counts only where the sensor could have seen the target.
/// @param times  where to add the time of each stage; the result does not depend on it
TrackerState step(const TrackerDesign& design, TrackerState state, const Scan& scan,
                  StepTimes* times = nullptr);

/// What the tracker says after its latest scan.
TrackSnapshot snapshot(const TrackerState& state);

}  // namespace ghtrack

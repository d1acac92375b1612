#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "sensors/observation.hpp"
#include "tools/run/known_association.hpp"
#include "tracker/replay.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {

/// A tracker on its way through a run. It sees the scans of the observations alone, unless its
/// configuration asks for `association: known`. A value: a copy of a fresh one serves another run.
class SceneTracker {
 public:
  /// @param sensors  the data sheets, by Scan::sensor
  /// @throws std::invalid_argument if a filter cannot be designed, such as for unstable gains
  SceneTracker(TrackerConfig config, std::vector<SensorTraits> sensors);

  // Out of line: to copy all filters is much code.
  SceneTracker(const SceneTracker&);
  SceneTracker(SceneTracker&&) noexcept;
  SceneTracker& operator=(const SceneTracker&);
  SceneTracker& operator=(SceneTracker&&) noexcept;
  ~SceneTracker();

  /// Processes an observation that has arrived.
  ScanFate step(const Observation& observation);

  /// What it says after the latest scan.
  TrackSnapshot snapshot() const;
  /// What it knows of a time not before the latest scan: its filters' predictions.
  TrackSnapshot predicted(double time) const;

  const TrackerDesign& design() const { return design_; }
  /// By Scan::sensor, as far as scans have come.
  const std::vector<ArrivalCounts>& arrivals() const;
  /// Detections without a finite position and covariance.
  std::int64_t detections_refused() const;

 private:
  TrackerDesign design_;
  std::variant<ReplayState, KnownReplayState> state_;
};

}  // namespace ghtrack

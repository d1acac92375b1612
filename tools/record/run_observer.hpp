#pragma once

#include <vector>

#include "tools/record/step_record.hpp"

namespace ghtrack {

/// Whoever wants to hear of a run: files, metrics, a film, a picture for a report. Observers only
/// listen: nothing that they do changes the run. Each may throw to end it.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  /// A sensor has looked at the truth. Scans come in the order of time.
  virtual void add_observation(const TruthSnapshot& /*truth*/, const Observation& /*observation*/) {
  }

  /// The scan has arrived, and one of the contenders has dealt with it; called for each of them,
  /// scan by scan in the order of arrival.
  virtual void add_tracks(const StepRecord& /*record*/) {}

  /// What a contender knows at the instant of a scan: its tracks, predicted to it, once all that
  /// has arrived by then is dealt with. Only where sensors have a latency: else that is what it
  /// says of the scan.
  virtual void add_known(const TruthSnapshot& /*truth*/, const TrackSnapshot& /*tracks*/,
                         std::size_t /*contender*/) {}

  /// The truth at an instant for a picture. At equal times scans come first.
  virtual void add_frame(const TruthSnapshot& /*truth*/) {}
};

using RunObservers = std::vector<RunObserver*>;

}  // namespace ghtrack

#pragma once

#include <cstddef>

#include "sensors/observation.hpp"
#include "sim/truth.hpp"
#include "tracker/arrival.hpp"
#include "tracker/track.hpp"

namespace ghtrack {

/// What one scan was to one tracker: what was true and what was seen at the instant of the scan,
/// and what the tracker concluded once it had arrived.
struct StepRecord {
  TruthSnapshot truth;
  Observation observation;
  TrackSnapshot tracks;       // after a late scan: of the latest scan all the same
  std::size_t contender = 0;  // who concluded
  ScanFate fate = ScanFate::kProcessed;

  /// Whether the tracks are those of the instant of the scan.
  bool is_in_order() const { return fate == ScanFate::kProcessed; }
};

}  // namespace ghtrack

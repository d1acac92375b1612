#pragma once

#include "sensors/observation.hpp"
#include "sim/truth.hpp"
#include "tracker/track.hpp"

namespace ghtrack {

/// Everything that happened at one scan: what was true, what was seen, what was concluded.
struct StepRecord {
  TruthSnapshot truth;
  Observation observation;
  TrackSnapshot tracks;
};

}  // namespace ghtrack

#pragma once

#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/record/step_record.hpp"

namespace ghtrack::view {

/// A scan, with the truth of its instant, as it reaches a tracker.
struct Arrival {
  double time = 0.0;  // [s]
  TruthSnapshot truth;
  Observation observation;
};

/// A run without its tracker: any tracker can be tried on it afterwards.
struct Recording {
  std::vector<TruthSnapshot> frames;  // the truth at the times of the pictures
  std::vector<Arrival> arrivals;      // in the order in which they arrive
};

/// Simulates and senses a scene.
/// @param frame_times  ascending [s]
Recording record(const WorldScene& scene, const std::vector<double>& frame_times);

}  // namespace ghtrack::view

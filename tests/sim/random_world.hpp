#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace ghtrack {

/// A world whose every number is random within what its description allows, bounds included; half
/// of them with the targets so close together that they meet.
WorldConfig random_world(std::uint64_t seed);

/// What became of a random world within half a second of its time.
struct RandomRun {
  bool finite = true;     // every position and velocity
  double cpu_time = 0.0;  // [s]
  long collisions_missed = 0;
};

RandomRun run_random_world(std::uint64_t seed);

}  // namespace ghtrack

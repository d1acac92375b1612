#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace ghtrack {

/// Less is rest: what stays within 1e-9 m for a twentieth of a second may be as slow as 2e-8 m/s
/// [m/s, m/s²].
inline constexpr double kAtRest = 2e-8;

/// Balls between walls and ramps, on level ground, in a valley or in a bowl, some touching from the
/// start, without air, wind or anything that drives them.
WorldConfig energy_world(std::uint64_t seed);

/// What became of the energy of such a world.
struct EnergyRun {
  double begun = 0.0;        // kinetic, of rotation and potential above the lowest point [J]
  double most_gained = 0.0;  // from one sample to a later one [J]
  double lowest = 0.0;       // of all gaps between balls and surroundings [m]
  double most_unrest = 0.0;  // velocity [m/s] or acceleration [m/s²] of a ball that rests
  int afloat = 0;            // balls at rest that touch nothing
  long collisions_missed = 0;
  double cpu_time = 0.0;  // [s]
};

EnergyRun run_energy_world(std::uint64_t seed);

}  // namespace ghtrack

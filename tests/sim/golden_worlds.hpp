#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace ghtrack {

/// A train, balls that hit each other, sloping ground, a wall, a box and the train, balloons that
/// touch in Dryden turbulence, a drone that drops a ball, juggling, and copies.
WorldConfig busy_world();

/// Objects that never meet: every lift law, the drag crisis, a sprung train that stops at a station
/// on a slope, a balloon with fluid acceleration; shear, gusts, vortices, harmonics and
/// Ornstein-Uhlenbeck turbulence.
WorldConfig stormy_world();

/// FNV-1a over the bits of position, velocity and acceleration of every object.
std::uint64_t truth_hash(const TruthSnapshot& truth, std::uint64_t hash = 0xcbf29ce484222325);

/// The same over a run with seed 7, sampled from 0 to `duration` [s] at `rate` [Hz].
std::uint64_t truth_hash(const WorldConfig& config, double duration, double rate);

}  // namespace ghtrack

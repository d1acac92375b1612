#include "sim/environment.hpp"

namespace ghtrack {

Environment::Environment(const EnvironmentConfig& config, std::uint64_t seed)
    : gravity_(0.0, -config.gravity),
      air_(config.air),
      wind_(config.wind, config.ground ? config.ground->height : 0.0, seed) {
  if (config.ground) append_surfaces(*config.ground, surfaces_);
  for (const Wall& wall : config.walls) append_surfaces(wall, surfaces_);
  for (const SolidBox& box : config.boxes) append_surfaces(box, surfaces_);
}

}  // namespace ghtrack

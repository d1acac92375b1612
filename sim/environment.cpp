#include "sim/environment.hpp"

namespace ghtrack {

Environment::Environment(const EnvironmentConfig& config, std::uint64_t seed)
    : gravity_(0.0, -config.gravity),
      air_(config.air),
      wind_(config.wind, config.ground ? config.ground->height : 0.0, seed) {
  if (config.ground) surfaces_.emplace_back(*config.ground);
  for (const Wall& wall : config.walls) surfaces_.emplace_back(wall);
}

}  // namespace ghtrack

#include "sim/environment.hpp"

#include <algorithm>

#include "sim/portable_math.hpp"

namespace ghtrack {

Environment::Environment(const EnvironmentConfig& config, std::uint64_t seed)
    : gravity_(0.0, -config.gravity),
      air_(config.air),
      wind_(config.wind, config.ground ? config.ground->height : 0.0, seed),
      seed_(seed) {
  const auto append = [this](const auto& thing, const std::string& name) {
    append_surfaces(thing, surfaces_);
    surface_names_.resize(surfaces_.size(), name);
  };
  if (config.ground) append(*config.ground, "ground");
  for (std::size_t i = 0; i < config.walls.size(); ++i) {
    append(config.walls[i], "walls[" + std::to_string(i) + "]");
  }
  for (std::size_t i = 0; i < config.boxes.size(); ++i) {
    append(config.boxes[i], "boxes[" + std::to_string(i) + "]");
  }
}

/// ρ/ρ₀ of the International Standard Atmosphere (ISO 2533): 288.15 K − 6.5 K/km up to 11 km, where
/// it is (T/T₀)^4.2559, and isothermal above, e^(−(h − 11 km) / 6341.6 m).
double Environment::standard_thinning(double height) {
  constexpr double kTropopause = 11'000.0;
  const double below = std::clamp(height, -5000.0, kTropopause);
  const double thinning = portable::pow(1.0 - 0.0065 / 288.15 * below, 4.25588);
  if (height <= kTropopause) return thinning;
  return thinning * portable::exp((kTropopause - height) / 6341.62);
}

}  // namespace ghtrack

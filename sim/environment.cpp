#include "sim/environment.hpp"

#include <algorithm>

#include "sim/portable_math.hpp"

namespace ghtrack {

Environment::Environment(const EnvironmentConfig& config, std::uint64_t seed)
    : gravity_(0.0, -config.gravity),
      air_(config.air),
      wind_(config.wind, config.ground ? config.ground->height : 0.0, seed),
      ground_(config.ground),
      boxes_(config.boxes),
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

bool Environment::is_solid(const Vec2& place) const {
  if (ground_ && place.y() < ground_->height_at(place.x())) return true;
  return std::any_of(boxes_.begin(), boxes_.end(),
                     [&](const SolidBox& box) { return box.contains(place); });
}

/// ρ/ρ₀ of the International Standard Atmosphere (ISO 2533), up to 47 km: where the temperature
/// changes by L with height it is (T/T₀)^−(1 + g/(R L)) of that at the layer's foot, with
/// g/R = 34.163 K/km, and where it does not, e^(−Δh g/(R T)). Beyond, the temperature stays.
double Environment::standard_thinning(double height) {
  constexpr double kTropopause = 11'000.0, kWarming = 20'000.0, kWarmer = 32'000.0,
                   kStratopause = 47'000.0;
  const double below = std::clamp(height, -5000.0, kTropopause);
  double thinning = portable::pow(1.0 - 0.0065 / 288.15 * below, 4.25588);
  if (height <= kTropopause) return thinning;
  thinning *= portable::exp((kTropopause - std::min(height, kWarming)) / 6341.62);
  if (height <= kWarming) return thinning;
  thinning *=
      portable::pow(1.0 + 0.001 / 216.65 * (std::min(height, kWarmer) - kWarming), -35.1632);
  if (height <= kWarmer) return thinning;
  const double above = std::min(height, kStratopause) - kWarmer;
  thinning *= portable::pow(1.0 + 0.0028 / 228.65 * above, -13.2011);
  return thinning * portable::exp((kStratopause - std::max(height, kStratopause)) / 7922.27);
}

}  // namespace ghtrack

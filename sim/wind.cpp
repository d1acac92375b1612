#include "sim/wind.hpp"

#include <cmath>
#include <limits>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kBoundaryLayer = 1000.0;  // its depth [m]

double speed_at(const LogarithmicShear& shear, double height) {
  if (height <= shear.roughness) return 0.0;
  return shear.friction_velocity / shear.karman * portable::log(height / shear.roughness);
}

double speed_at(const PowerShear& shear, double height) {
  if (height <= 0.0) return 0.0;
  return shear.speed * portable::pow(height / shear.height, shear.exponent);
}

Vec2 gust_at(const OneMinusCosineGust& gust, double time) {
  if (time <= gust.at) return Vec2::Zero();
  if (time >= gust.at + gust.over) return gust.change;
  const double half_turns = (time - gust.at) / gust.over;
  return 0.5 * (1.0 - portable::sin_cos_of_turns(0.5 * half_turns).cos) * gust.change;
}

Vec2 whirl_at(const RankineVortex& vortex, const Vec2& position, double time) {
  const Vec2 radius = position - vortex.center - time * vortex.velocity;
  const double r = radius.norm() / vortex.radius;
  const Vec2 around = left_of(radius);
  // |around| = r R, so V (r or r^−n) along it is V/R inside and V r^−(n+1) / R outside.
  const double decay = r <= 1.0 ? 1.0 : portable::pow(r, -vortex.exponent - 1.0);
  return vortex.velocity + vortex.max_speed * decay / vortex.radius * around;
}

Vec2 whirl_at(const HollandVortex& vortex, const Vec2& position, double time) {
  const Vec2 radius = position - vortex.center - time * vortex.velocity;
  const double r = radius.norm();
  if (r == 0.0) return vortex.velocity;
  const double q = portable::pow(vortex.radius / r, vortex.shape);
  const double rotation = 0.5 * r * vortex.coriolis;
  const double cyclostrophic =
      q > 700.0 ? 0.0 : vortex.max_speed * vortex.max_speed * q * portable::exp(1.0 - q);
  const double speed = std::sqrt(cyclostrophic + rotation * rotation) - rotation;
  const portable::SinCos inflow = portable::sin_cos(vortex.inflow_deg * portable::kDegree);
  const Vec2 outwards = radius / r;
  const Vec2 around = left_of(outwards);
  return vortex.velocity + speed * (inflow.cos * around - inflow.sin * outwards);
}

}  // namespace

Wind::Wind(const WindConfig& config, double ground, std::uint64_t seed)
    : config_(config), ground_(ground), turbulence_(config.turbulence, config.mean, seed) {
  for (const Gust& gust : config.gusts) {
    if (const auto* step = std::get_if<StepGust>(&gust)) kinks_.push_back(step->at);
    if (const auto* smooth = std::get_if<OneMinusCosineGust>(&gust)) {
      kinks_.push_back(smooth->at);
      kinks_.push_back(smooth->at + smooth->over);
    }
  }
  std::sort(kinks_.begin(), kinks_.end());
  steady_ = kinks_.empty() && !turbulence_.has_common_knots();
  uniform_ = steady_ && turbulence_.calm() && !config.shear && config.vortices.empty() &&
             config.modes.empty();
}

Vec2 Wind::at(const Vec2& position, double time) const {
  Vec2 wind = without_jumps(position, time);
  for (const Gust& gust : config_.gusts) {
    const auto* jump = std::get_if<StepGust>(&gust);
    if (jump != nullptr && time >= jump->at) wind += jump->change;
  }
  return wind;
}

Vec2 Wind::without_jumps(const Vec2& position, double time) const {
  Vec2 wind = config_.mean;
  if (uniform_) return wind;
  if (config_.shear) {
    wind.x() += std::visit(
        [&](const auto& shear) {
          return speed_at(shear, std::min(position.y() - ground_, kBoundaryLayer));
        },
        *config_.shear);
  }
  for (const Gust& gust : config_.gusts) {
    const auto* smooth = std::get_if<OneMinusCosineGust>(&gust);
    if (smooth != nullptr) wind += gust_at(*smooth, time);
  }
  for (const Vortex& vortex : config_.vortices) {
    wind += std::visit([&](const auto& w) { return whirl_at(w, position, time); }, vortex);
  }
  for (const WindMode& mode : config_.modes) {
    const double angle = mode.angular_frequency * time;
    wind.x() += mode.amplitude.x() * portable::sin_cos(angle + mode.phase.x()).cos;
    wind.y() += mode.amplitude.y() * portable::sin_cos(angle + mode.phase.y()).cos;
  }
  return wind + turbulence_.at(position, time);
}

Vec2 Wind::material_derivative(const Vec2& position, double time, double earliest,
                               double latest) const {
  if (uniform_) return Vec2::Zero();
  constexpr double kHalfSpan = 1e-4;  // [s]; the rounding error is then 1e-11 m/s²
  const Vec2 wind = at(position, time);
  const double before = std::max({0.0, earliest, time - kHalfSpan});
  const double after = std::min(latest, time + kHalfSpan);
  return (without_jumps(position + (after - time) * wind, after) -
          without_jumps(position - (time - before) * wind, before)) /
         (after - before);
}

double Wind::next_kink(double time) const {
  double next = std::numeric_limits<double>::infinity();
  const auto gust = std::upper_bound(kinks_.begin(), kinks_.end(), time);
  if (gust != kinks_.end()) next = *gust;
  if (!turbulence_.has_common_knots()) return next;
  double knot = std::floor(time * Turbulence::kKnotsPerSecond) + 1.0;
  // The division may round to `time` itself, or to less than a rounding error above it.
  while (knot / Turbulence::kKnotsPerSecond <= time + 1e-9) knot += 1.0;
  return std::min(next, knot / Turbulence::kKnotsPerSecond);
}

}  // namespace ghtrack

#include "tracker/filters/implied_noise.hpp"

#include <algorithm>
#include <cmath>

namespace ghtrack {
namespace {

/// Gains beyond follow the measurements: there is no more noise to be implied.
constexpr double kLargestShare = 0.98;

}  // namespace

AxisCovariance<double> NoiseDensities::over(double dt) const {
  AxisCovariance<double> sum = process_noise(ProcessModel::kWhiteNoise, 0, velocity, dt);
  if (acceleration > 0.0) sum += process_noise(ProcessModel::kWhiteNoise, 1, acceleration, dt);
  if (jerk > 0.0) sum += process_noise(ProcessModel::kWhiteNoise, 2, jerk, dt);
  return sum;
}

NoiseDensities implied_noise(const Gains& gains, double sigma, double dt) {
  const double g = std::min(gains.g, kLargestShare);
  const double h = gains.order >= 1 ? gains.h : 0.0;
  const double c = gains.order >= 2 ? 2.0 * gains.k : 0.0;
  const double s = 1.0 / (1.0 - g);
  const double jerk = c * c * s;
  const double acceleration = (h * h - 2.0 * g * c) * s;
  const double aa = c * s * (h - 0.5 * c);
  const double va = g * c * s - 0.5 * aa - jerk / 6.0;
  const double vv = g * h * s - 1.5 * va - c - 0.5 * aa - 0.5 * acceleration - jerk / 8.0;
  const double velocity =
      g * g * s - 2.0 * h - c - vv - va - 0.25 * aa - acceleration / 3.0 - jerk / 20.0;

  const double r = sigma * sigma;
  const double dt2 = dt * dt;
  return {.velocity = std::max(velocity, 0.0) * r / dt,
          .acceleration = std::max(acceleration, 0.0) * r / (dt * dt2),
          .jerk = jerk * r / (dt * dt2 * dt2)};
}

AxisCovariance<double> steady_covariance(const NoiseDensities& noise, int order, double sigma,
                                         double dt) {
  const double r = sigma * sigma;
  const AxisCovariance<double> p = settled_prediction(noise.over(dt), order, r, dt);
  const double s = p.xx + r;
  return corrected(p, {p.xx / s, p.xv / s, p.xa / s}, r);
}

}  // namespace ghtrack

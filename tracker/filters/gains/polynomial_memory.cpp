#include "tracker/filters/gains/polynomial_memory.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tracker/filters/gains/order.hpp"

namespace ghtrack {
namespace {

void require_fading(double theta) {
  if (!(theta >= 0.0 && theta < 1.0)) throw std::invalid_argument("theta must lie in [0, 1)");
}

}  // namespace

std::array<double, 3> growing_memory_sigma(int order, int n, double sigma, double dt) {
  require_order(order);
  if (n < 1) throw std::invalid_argument("growing memory counts measurements from 1");
  const double m = n;
  const double infinity = std::numeric_limits<double>::infinity();
  if (order == 0) return {sigma / std::sqrt(m), 0.0, 0.0};
  if (n <= order) return {infinity, infinity, order == 2 ? infinity : 0.0};
  if (order == 1) {
    return {sigma * std::sqrt(2.0 * (2.0 * m - 1.0) / (m * (m + 1.0))),
            sigma / dt * std::sqrt(12.0 / (m * (m * m - 1.0))), 0.0};
  }
  const double d = m * (m * m - 1.0) * (m * m - 4.0);
  return {sigma * std::sqrt(3.0 * (3.0 * m * m - 3.0 * m + 2.0) / (m * (m + 1.0) * (m + 2.0))),
          sigma / dt * std::sqrt(12.0 * (16.0 * m * m - 30.0 * m + 11.0) / d),
          sigma / (dt * dt) * std::sqrt(720.0 / d)};
}

std::array<double, 3> fading_memory_variance(int order, double theta, double dt) {
  require_order(order);
  require_fading(theta);
  const double q = theta;
  const double s = 1.0 - q;
  const double p = 1.0 + q;
  const double t2 = dt * dt;
  if (order == 0) return {s / p, 0.0, 0.0};
  if (order == 1) {
    const double p3 = p * p * p;
    return {s * (1.0 + q * (4.0 + 5.0 * q)) / p3, 2.0 * s * s * s / (t2 * p3), 0.0};
  }
  const double p5 = p * p * p * p * p;
  const double s3 = s * s * s;
  return {s * (1.0 + q * (6.0 + q * (16.0 + q * (24.0 + 19.0 * q)))) / p5,
          s3 * (13.0 + q * (50.0 + 49.0 * q)) / (2.0 * t2 * p5), 6.0 * s3 * s * s / (t2 * t2 * p5)};
}

std::array<double, 3> fading_memory_truncation_error(int order, double theta, double dt) {
  require_order(order);
  require_fading(theta);
  const double s = 1.0 - theta;
  const double r = theta / s;
  const double t2 = dt * dt;
  if (order == 0) return {dt * r, 0.0, 0.0};
  if (order == 1) return {2.0 * t2 * r * r, dt * (1.0 + 3.0 * theta) / s, 0.0};
  return {6.0 * t2 * dt * r * r * r, t2 * (2.0 + theta * (5.0 + 11.0 * theta)) / (s * s),
          6.0 * dt * (1.0 + 2.0 * theta) / s};
}

}  // namespace ghtrack

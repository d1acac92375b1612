#include "tracker/filters/gains/rules.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tracker/filters/gains/order.hpp"

namespace ghtrack {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

/// The zero of an increasing function on (0, 1), to the last bit.
template <class Function>
double root_in_unit_interval(Function increasing) {
  double low = 0.0;
  double high = 1.0;
  while (true) {
    const double middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return high;
    (increasing(middle) < 0.0 ? low : high) = middle;
  }
}

// All Kalman-optimal pairs are written in u = 1 − √(1 − α): no digits cancel for small λ.
double alpha_of(double u) { return u * (2.0 - u); }

Gains white_noise_pair(double u) {
  const double g = alpha_of(u);
  const double root = std::sqrt(3.0 * (g * g - 12.0 * g + 12.0));
  return Gains::of_gh(g, 6.0 * g * g / (3.0 * (2.0 - g) + root));
}

Gains kalata_pair(double u) { return Gains::of_gh(alpha_of(u), 2.0 * u * u); }

Gains tracking_index_pair(double index, ProcessModel model) {
  switch (model) {
    case ProcessModel::kPiecewiseConstant:
      break;
    case ProcessModel::kRandomWalk: {
      const double u = root_in_unit_interval([index](double v) {
        const double s = 1.0 - v;
        return alpha_of(v) * alpha_of(v) - index * s * (1.0 + s * s);
      });
      return benedict_bordner_gains(alpha_of(u));
    }
    case ProcessModel::kWhiteNoise:
      return white_noise_pair(root_in_unit_interval(
          [index](double v) { return white_noise_pair(v).h - index * (1.0 - v); }));
  }
  return kalata_pair(2.0 * index / (std::sqrt(8.0 * index + index * index) + index));
}

}  // namespace

Gains growing_memory_gains(int order, int n) {
  require_order(order);
  require(n >= 1, "growing memory counts measurements from 1");
  const double m = n;
  if (order == 0) return Gains::of_g(1.0 / m);
  if (order == 1) {
    const double d = m * (m + 1.0);
    return Gains::of_gh(2.0 * (2.0 * m - 1.0) / d, 6.0 / d);
  }
  const double d = m * (m + 1.0) * (m + 2.0);
  return Gains::of_ghk(3.0 * (3.0 * m * m - 3.0 * m + 2.0) / d, 18.0 * (2.0 * m - 1.0) / d,
                       30.0 / d);
}

Gains start_up_gains(int order, int n) {
  require_order(order);
  Gains gains = growing_memory_gains(std::min(order, n - 1), n);
  gains.order = order;
  return gains;
}

Gains fading_memory_gains(int order, double theta) {
  require_order(order);
  require(theta >= 0.0 && theta <= 1.0, "theta must lie in [0, 1]");
  const double s = 1.0 - theta;
  if (order == 0) return Gains::of_g(s);
  if (order == 1) return Gains::of_gh(1.0 - theta * theta, s * s);
  return Gains::of_ghk(1.0 - theta * theta * theta, 1.5 * s * s * (1.0 + theta), 0.5 * s * s * s);
}

Gains benedict_bordner_gains(double g) {
  require(g > 0.0 && g <= 1.0, "Benedict-Bordner needs 0 < g ≤ 1");
  return Gains::of_gh(g, g * g / (2.0 - g));
}

Gains third_order_benedict_bordner_gains(double g) {
  require(g > 0.0 && g <= 1.0, "third-order Benedict-Bordner needs 0 < g ≤ 1");
  const double u = g / (1.0 + std::sqrt(1.0 - g));
  const double h = 2.0 * u * u;
  return Gains::of_ghk(g, h, h * h / (4.0 * g));
}

Gains polge_bhagavan_gains(double g) {
  require(g > 0.0 && g < 1.0, "Polge-Bhagavan needs 0 < g < 1");
  // h = [2g³ − 4g² + √(4g⁶ − 64g⁵ + 64g⁴)] / 8(1 − g), freed of the difference of like numbers.
  const double root = std::sqrt(g * g - 16.0 * g + 16.0);
  const double h = g * g * (2.0 * g - 4.0 + 2.0 * root) / (8.0 * (1.0 - g));
  return Gains::of_ghk(g, h, (h * (2.0 - g) - g * g) / g);
}

Gains critically_damped_gains(double g) {
  require(g > 0.0 && g <= 1.0, "critical damping needs 0 < g ≤ 1");
  const double u = g / (1.0 + std::sqrt(1.0 - g));
  return Gains::of_gh(g, u * u);
}

Gains tracking_index_gains(int order, double index, ProcessModel model) {
  require_order(order);
  require(index >= 0.0 && std::isfinite(index),
          "the tracking index must be finite and not negative");
  require(order == 1 || model != ProcessModel::kWhiteNoise,
          "continuous white noise has a closed form for order 1 only");
  if (index == 0.0) return {order, 0.0, 0.0, 0.0};
  if (order == 0) return Gains::of_g(2.0 * index / (std::sqrt(index * index + 16.0) + index));
  if (order == 1) return tracking_index_pair(index, model);
  const double u = root_in_unit_interval(
      [index](double v) { return 2.0 * v * v * v - index * (1.0 - v) * (2.0 - v); });
  const Gains pair = kalata_pair(u);
  return Gains::of_ghk(pair.g, pair.h, pair.h * pair.h / (4.0 * pair.g));
}

double implied_tracking_index(const Gains& gains) {
  require(gains.order == 1 && gains.g < 1.0, "a tracking index is implied by g-h gains with g < 1");
  return gains.h / std::sqrt(1.0 - gains.g);
}

Gains maximum_acceleration_gains(double deviation) {
  require(deviation > 0.0 && std::isfinite(deviation), "the deviation A T² / σ must be positive");
  // On Kalata's curve the noise is u (3 − 2u) / (2 − u) and the lag (1 − u)² / 2u² per unit of
  // deviation; the sum of squares has its minimum where the derivative below vanishes.
  const double d2 = deviation * deviation;
  return kalata_pair(root_in_unit_interval([d2](double u) {
    const double s = (1.0 - u) * (2.0 - u);
    return 2.0 * (3.0 - u) * u * u * u * u * u - d2 * s * s;
  }));
}

}  // namespace ghtrack

#include "tracker/filters/gains/analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

void refuse_unstable(const Gains& gains) {
  if (const auto violated = violated_inequality(gains)) {
    throw std::invalid_argument("unstable gains: " + std::string(*violated) + " is violated");
  }
}

/// D of the three-gain formulas, positive for stable gains.
double third_order_denominator(const Gains& q) {
  return (4.0 - 2.0 * q.g - q.h) * (q.g * q.h + q.g * q.k - 2.0 * q.k);
}

/// Characteristic polynomial of the three-gain filter in w = 1 − z: w³ − p w² + q w − r. Its
/// coefficients have the gains' own size, so that small gains keep their digits.
struct Cubic {
  double p, q, r;
  double operator()(double w) const { return ((w - p) * w + q) * w - r; }
};

Cubic characteristic_cubic(const Gains& q) { return {q.g + q.h + q.k, q.h + 3.0 * q.k, 2.0 * q.k}; }

std::array<std::complex<double>, 2> quadratic_roots(double b, double c) {
  const double discriminant = b * b - 4.0 * c;
  if (discriminant < 0.0) {
    const double imaginary = 0.5 * std::sqrt(-discriminant);
    return {std::complex(-0.5 * b, imaginary), std::complex(-0.5 * b, -imaginary)};
  }
  const double far = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  return {far, far == 0.0 ? 0.0 : c / far};
}

/// A real root: Cauchy's bound brackets one, bisection finds it to the last bit.
double real_root(const Cubic& cubic) {
  const double bound = 1.0 + std::max({std::abs(cubic.p), std::abs(cubic.q), std::abs(cubic.r)});
  double low = -bound;
  double high = bound;
  while (true) {
    const double middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return high;
    (cubic(middle) < 0.0 ? low : high) = middle;
  }
}

}  // namespace

std::optional<std::string_view> violated_inequality(const Gains& gains) {
  const auto [order, g, h, k] = gains;
  if (!(g > 0.0)) return "0 < g";
  if (order == 1 && !(h > 0.0)) return "0 < h";
  if (order != 1 && !(g < 2.0)) return "g < 2";
  if (order >= 1 && !(2.0 * g + h < 4.0)) return "2g + h < 4";
  if (order == 2 && !(k > 0.0)) return "0 < k";
  if (order == 2 && !(k * (2.0 - g) < g * h)) return "k < g h / (2 - g)";
  return std::nullopt;
}

std::vector<std::complex<double>> poles(const Gains& gains) {
  std::vector<std::complex<double>> roots;  // of w = 1 − z
  if (gains.order == 0) {
    roots = {gains.g};
  } else if (gains.order == 1) {
    const auto pair = quadratic_roots(-(gains.g + gains.h), gains.h);
    roots.assign(pair.begin(), pair.end());
  } else {
    const Cubic cubic = characteristic_cubic(gains);
    const double real = real_root(cubic);
    const double b = real - cubic.p;
    const auto pair = quadratic_roots(b, cubic.q + real * b);
    roots = {real, pair[0], pair[1]};
  }
  for (auto& root : roots) root = 1.0 - root;
  std::stable_sort(roots.begin(), roots.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return roots;
}

std::string_view to_string(Damping damping) {
  switch (damping) {
    case Damping::kUnder:
      return "under";
    case Damping::kCritical:
      return "critical";
    case Damping::kOver:
      return "over";
    case Damping::kAlternating:
      return "alternating";
  }
  return "";
}

namespace {

constexpr double kRounding = 1e-12;

Damping damping_of_pair(const Gains& q) {
  const double sum = q.g + q.h;
  const double discriminant = sum * sum - 4.0 * q.h;
  const bool equal = std::abs(discriminant) <= kRounding * sum * sum;
  if (!equal && discriminant < 0.0) return Damping::kUnder;
  if (q.g > 1.0 || sum > 2.0) return Damping::kAlternating;
  return equal ? Damping::kCritical : Damping::kOver;
}

Damping damping_of_triple(const Gains& gains) {
  const auto [p, q, r] = characteristic_cubic(gains);
  const double positive = 18.0 * p * q * r + p * p * q * q;
  const double negative = 4.0 * p * p * p * r + 4.0 * q * q * q + 27.0 * r * r;
  if (positive - negative < -kRounding * (positive + negative)) return Damping::kUnder;
  const double p2 = p * p;
  if (std::abs(p2 - 3.0 * q) <= kRounding * p2 && p <= 3.0) return Damping::kCritical;
  // Real roots are all positive when the coefficients of the polynomial in z alternate in sign.
  const bool positive_poles =
      p <= 3.0 && 3.0 - 2.0 * gains.g - gains.h + gains.k >= 0.0 && gains.g <= 1.0;
  return positive_poles ? Damping::kOver : Damping::kAlternating;
}

}  // namespace

Damping damping(const Gains& gains) {
  if (gains.order == 0) return gains.g > 1.0 ? Damping::kAlternating : Damping::kOver;
  return gains.order == 1 ? damping_of_pair(gains) : damping_of_triple(gains);
}

double damping_ratio(const Gains& gains) {
  const std::complex<double> slowest = poles(gains).front();
  if (slowest.imag() == 0.0 && slowest.real() >= 0.0) return 1.0;
  const double decay = -0.5 * portable::log(std::norm(slowest));
  const double turn = portable::atan2(slowest.imag(), slowest.real());
  return decay / std::sqrt(decay * decay + turn * turn);
}

VarianceReduction variance_reduction(const Gains& gains, double dt) {
  refuse_unstable(gains);
  const auto [order, g, h, k] = gains;
  const double t2 = dt * dt;
  if (order == 0) {
    const double vrf = g / (2.0 - g);
    return {.x = vrf, .prediction = vrf};
  }
  if (order == 1) {
    const double d = g * (4.0 - 2.0 * g - h);
    return {.x = (2.0 * g * g + 2.0 * h - 3.0 * g * h) / d,
            .dx = 2.0 * h * h / (t2 * d),
            .prediction = (2.0 * g * g + 2.0 * h + g * h) / d,
            .x_dx = h * (2.0 * g - h) / (dt * d)};
  }
  const double d = third_order_denominator(gains);
  const double slack = 4.0 - 2.0 * g - h;
  return {.x = (h * (2.0 * g * g - 3.0 * g * h + 2.0 * h) - g * k * slack) / d,
          .dx = (2.0 * h * h * h - 4.0 * h * h * k + 4.0 * k * k * (2.0 - g)) / (t2 * d),
          .ddx = 8.0 * h * k * k / (t2 * t2 * d),
          .prediction = (h * (2.0 * g * g + g * h + 2.0 * h) - g * k * slack) / d,
          .x_dx = h * (2.0 * g - h) * (h - k) / (dt * d)};
}

double innovation_variance(const Gains& gains, double sigma, double dt) {
  return sigma * sigma * (1.0 + variance_reduction(gains, dt).prediction);
}

Lag steady_lag(const Gains& gains, double dt, double next_derivative) {
  refuse_unstable(gains);
  const auto [order, g, h, k] = gains;
  if (order == 0) {
    const double prediction = next_derivative * dt / g;
    return {.prediction = prediction, .x = (1.0 - g) * prediction};
  }
  if (order == 1) {
    const double prediction = next_derivative * dt * dt / h;
    return {.prediction = prediction,
            .x = (1.0 - g) * prediction,
            .dx = next_derivative * dt * (2.0 * g - h) / (2.0 * h)};
  }
  const double prediction = next_derivative * dt * dt * dt / (2.0 * k);
  return {.prediction = prediction,
          .x = (1.0 - g) * prediction,
          .dx = next_derivative * dt * dt * (6.0 * g - 3.0 * h + k) / (12.0 * k),
          .ddx = next_derivative * dt * (h - k) / (2.0 * k)};
}

double predicted_rmse(const Gains& gains, double sigma, double dt, double next_derivative) {
  const double lag = steady_lag(gains, dt, next_derivative).x;
  return std::sqrt(sigma * sigma * variance_reduction(gains, dt).x + lag * lag);
}

TransientEnergy transient_energy(const Gains& gains, double dt) {
  refuse_unstable(gains);
  const auto [order, g, h, k] = gains;
  const double t2 = dt * dt;
  if (order == 0) return {.position = 1.0 / (g * (2.0 - g))};
  if (order == 1) {
    const double slack = 4.0 - 2.0 * g - h;
    return {.position = 2.0 / (g * slack), .velocity = t2 * (2.0 - g) / (g * h * slack)};
  }
  const double d = third_order_denominator(gains);
  return {.position = 2.0 * h / d,
          .velocity = t2 * (2.0 - g) / d,
          .acceleration = t2 * t2 * g / (4.0 * k * (g * h + g * k - 2.0 * k))};
}

double settling_updates(const Gains& gains, double fraction) {
  refuse_unstable(gains);
  return std::max(1.0, portable::log(fraction) / portable::log(std::abs(poles(gains).front())));
}

}  // namespace ghtrack

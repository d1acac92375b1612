#include "tools/metrics/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kEnough = 1e-15;            // relative size of a term that ends a sum
constexpr std::int64_t kManyDegrees = 1000;  // from which on four terms beside the normal suffice

/// ln Γ(x) for x > 0: Stirling's series (Abramowitz & Stegun 6.1.41) from 15 on, where what is left
/// out is below 1e-16, and below that by Γ(x) = Γ(x + 1) / x.
double log_gamma(double x) {
  double product = 1.0;
  for (; x < 15.0; x += 1.0) product *= x;
  constexpr double kHalfLog2Pi = 0.91893853320467274178;
  const double y = 1.0 / (x * x);
  const double rest =
      (1.0 / 12.0 - y * (1.0 / 360.0 - y * (1.0 / 1260.0 - y * (1.0 / 1680.0 - y / 1188.0)))) / x;
  return (x - 0.5) * portable::log(x) - x + kHalfLog2Pi + rest - portable::log(product);
}

/// The regularised incomplete gamma functions.
struct GammaParts {
  double lower;  // P(a, x)
  double upper;  // Q(a, x) = 1 − P
};

GammaParts incomplete_gamma(double a, double x) {
  if (x <= 0.0) return {0.0, 1.0};
  const double scale = portable::exp(a * portable::log(x) - x - log_gamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; term > kEnough * sum; n += 1.0) {
      term *= x / n;
      sum += term;
    }
    return {scale * sum, 1.0 - scale * sum};
  }
  // The continued fraction of Q by Lentz's method.
  double b = x + 1.0 - a;
  double c = std::numeric_limits<double>::max();
  double d = 1.0 / b;
  double fraction = d;
  for (double n = 1.0, change = 0.0; std::abs(change - 1.0) > kEnough && n < 1e6; n += 1.0) {
    const double numerator = -n * (n - a);
    b += 2.0;
    d = 1.0 / (numerator * d + b);
    c = b + numerator / c;
    change = c * d;
    fraction *= change;
  }
  return {1.0 - scale * fraction, scale * fraction};
}

/// P(|T| < t) for Student's t with a whole number of degrees of freedom.
double student_central(double t, std::int64_t degrees) {
  const double theta = portable::atan2(t, std::sqrt(static_cast<double>(degrees)));
  const auto [sin, cos] = portable::sin_cos(theta);
  const double cos2 = cos * cos;
  const bool odd = degrees % 2 == 1;
  double term = odd ? cos : 1.0;
  double sum = degrees == 1 ? 0.0 : term;
  for (std::int64_t n = odd ? 3 : 2; n < degrees - 1; n += 2) {
    term *= cos2 * static_cast<double>(n - 1) / static_cast<double>(n);
    sum += term;
  }
  if (odd) return 2.0 / std::numbers::pi * (theta + sin * sum);
  return sin * sum;
}

/// Of Student's t.
double student_density(double t, double degrees) {
  const double scale = portable::exp(log_gamma(0.5 * (degrees + 1.0)) - log_gamma(0.5 * degrees)) /
                       std::sqrt(degrees * std::numbers::pi);
  return scale * portable::exp(-0.5 * (degrees + 1.0) * portable::log1p(t * t / degrees));
}

/// The quantile of Student's t by the normal one (Abramowitz & Stegun 26.7.5).
double near_normal_quantile(double z, double degrees) {
  const double z2 = z * z;
  const double terms[] = {
      (z2 + 1.0) / 4.0, ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0,
      (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0,
      ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0};
  double t = z;
  double power = z;
  for (const double term : terms) {
    power /= degrees;
    t += term * power;
  }
  return t;
}

}  // namespace

double normal_quantile(double probability) {
  if (probability > 0.5) return -normal_quantile(1.0 - probability);
  // A rational approximation of the upper tail, good to 4.5e-4 (Abramowitz & Stegun 26.2.23).
  const double t = std::sqrt(-2.0 * portable::log(probability));
  double z = t - ((0.010328 * t + 0.802853) * t + 2.515517) /
                     (((0.001308 * t + 0.189269) * t + 1.432788) * t + 1.0);
  for (int i = 0; i < 3; ++i) {
    const double tail = 0.5 * incomplete_gamma(0.5, 0.5 * z * z).upper;
    const double density = portable::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    z = std::max(0.0, z + (tail - probability) / density);
  }
  return -z;
}

double chi_square_probability(double x, double degrees) {
  return incomplete_gamma(0.5 * degrees, 0.5 * x).lower;
}

double chi_square_quantile(double probability, double degrees) {
  const double a = degrees / 2.0;
  const double spread = 2.0 / (9.0 * degrees);
  const double cube_root = 1.0 - spread + normal_quantile(probability) * std::sqrt(spread);
  // Where the approximation fails, in the lower tail of few degrees, the series' first term serves.
  double x = cube_root > 0.1
                 ? degrees * cube_root * cube_root * cube_root
                 : 2.0 * portable::exp((portable::log(probability) + log_gamma(a + 1.0)) / a);
  for (int i = 0; i < 50; ++i) {
    const double density =
        0.5 * portable::exp((a - 1.0) * portable::log(x / 2.0) - x / 2.0 - log_gamma(a));
    const double next = x - (incomplete_gamma(a, x / 2.0).lower - probability) / density;
    const double bounded = std::clamp(next, x / 2.0, x * 2.0);
    if (std::abs(bounded - x) <= 1e-13 * x) return bounded;
    x = bounded;
  }
  return x;
}

double student_quantile(double probability, std::int64_t degrees) {
  if (probability < 0.5) return -student_quantile(1.0 - probability, degrees);
  const double z = normal_quantile(probability);
  if (degrees > kManyDegrees) return near_normal_quantile(z, static_cast<double>(degrees));
  double low = 0.0;
  double high = 1e9;
  double t = z;
  for (int i = 0; i < 200; ++i) {
    const double excess = 0.5 + 0.5 * student_central(t, degrees) - probability;
    (excess < 0.0 ? low : high) = t;
    const double newton = t - excess / student_density(t, static_cast<double>(degrees));
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - t) <= kEnough * t) return next;
    t = next;
  }
  return t;
}

Interval chi_square_mean_bounds95(double count, double degrees) {
  return {chi_square_quantile(0.025, count * degrees) / count,
          chi_square_quantile(0.975, count * degrees) / count};
}

}  // namespace ghtrack

#include "sim/portable_math.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <limits>

namespace ghtrack::portable {
namespace {

constexpr double kLn2High = 6.93147180369123816490e-01;  // the upper bits: k × kLn2High is exact
constexpr double kLn2Low = 1.90821492927058770002e-10;
constexpr double kTwoPi = 6.283185307179586;

/// Taylor series in z = x²: Σ (−1)ⁱ zⁱ / (2i + first)! with the factorials' own first term.
template <std::size_t N>
double alternating_series(const std::array<double, N>& inverse_factorials, double z) {
  double sum = 0.0;
  for (std::size_t i = N; i-- > 0;) sum = inverse_factorials[i] - z * sum;
  return sum;
}

template <std::size_t N>
constexpr std::array<double, N> inverse_factorials(int first) {
  std::array<double, N> terms{};
  double factorial = 1.0;
  int n = 1;
  for (std::size_t i = 0; i < N; ++i) {
    for (; n <= first + 2 * static_cast<int>(i); ++n) factorial *= n;
    terms[i] = 1.0 / factorial;
  }
  return terms;
}

/// 1/n for the odd numbers 1, 3, 5, …
template <std::size_t N>
constexpr std::array<double, N> inverse_odd_numbers() {
  std::array<double, N> terms{};
  for (std::size_t i = 0; i < N; ++i) terms[i] = 1.0 / (2.0 * static_cast<double>(i) + 1.0);
  return terms;
}

/// std::floor for |x| < 2^52, without a call.
double floor_of(double x) {
  const auto towards_zero = static_cast<double>(static_cast<std::int64_t>(x));
  return towards_zero > x ? towards_zero - 1.0 : towards_zero;
}

constexpr auto kInverseOdd = inverse_odd_numbers<12>();
constexpr auto kSine = inverse_factorials<9>(1);
constexpr auto kCosine = inverse_factorials<9>(0);

/// atan(x) for |x| ≤ tan(π/16), by its series.
double small_atan(double x) {
  const double z = x * x;
  double sum = 0.0;
  for (std::size_t i = 12; i-- > 0;) sum = kInverseOdd[i] - z * sum;
  return x * sum;
}

/// atan(x) for 0 ≤ x ≤ 1: the nearest multiple of π/8 is taken off first.
double unit_atan(double x) {
  constexpr double kTanPi16 = 0.198912367379658;
  constexpr double kTan3Pi16 = 0.66817863791929891;
  constexpr double kTanPi8 = 0.41421356237309503;
  if (x <= kTanPi16) return small_atan(x);
  if (x <= kTan3Pi16) return kPi / 8.0 + small_atan((x - kTanPi8) / (1.0 + x * kTanPi8));
  return kPi / 4.0 + small_atan((x - 1.0) / (1.0 + x));
}

}  // namespace

double log(double x) {
  if (x < std::numeric_limits<double>::min()) {  // 0, negative or subnormal
    if (x == 0.0) return -std::numeric_limits<double>::infinity();
    if (x < 0.0) return std::numeric_limits<double>::quiet_NaN();
    return log(x * 0x1p54) - 54.0 * (kLn2High + kLn2Low);
  }
  if (!(x <= std::numeric_limits<double>::max())) return x;  // infinite or not a number
  // x = m 2^k with m in [√½, √2); ln m = 2 artanh((m − 1)/(m + 1)).
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0x000fffffffffffff) | 0x3ff0000000000000);
  if (mantissa > 1.4142135623730951) {
    mantissa *= 0.5;
    ++exponent;
  }
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  const double z = s * s;
  double sum = 0.0;
  for (std::size_t i = 11; i-- > 1;) sum = z * (kInverseOdd[i] + sum);
  const double k = exponent;
  return k * kLn2High + (2.0 * s + (2.0 * s * sum + k * kLn2Low));
}

double log1p(double x) {
  // The rounding of 1 + x cancels in the quotient (Goldberg 1991, theorem 4).
  const double y = 1.0 + x;
  return y == 1.0 ? x : log(y) * (x / (y - 1.0));
}

double exp(double x) {
  if (!(x >= -700.0)) return x < -700.0 ? 0.0 : x;
  if (x > 709.0) return std::numeric_limits<double>::infinity();
  const double k = std::floor(x * 1.4426950408889634 + 0.5);
  const double r = (x - k * kLn2High) - k * kLn2Low;
  double sum = 1.0;
  for (int n = 14; n >= 1; --n) sum = 1.0 + r * sum / n;
  return std::ldexp(sum, static_cast<int>(k));
}

double pow(double x, double y) { return exp(y * log(x)); }

SinCos sin_cos_of_turns(double turns) {
  const double whole = floor_of(turns * 4.0 + 0.5);
  const double angle = (turns - whole * 0.25) * kTwoPi;  // within ±π/4 of a quarter turn
  const double z = angle * angle;
  const double s = angle * alternating_series(kSine, z);
  const double c = alternating_series(kCosine, z);
  const double quarter = whole - 4.0 * floor_of(whole * 0.25);
  if (quarter == 1.0) return {c, -s};
  if (quarter == 2.0) return {-s, -c};
  if (quarter == 3.0) return {-c, s};
  return {s, c};
}

SinCos sin_cos(double angle) { return sin_cos_of_turns(angle / kTwoPi); }

double atan2(double y, double x) {
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  if (ax == 0.0 && ay == 0.0) return 0.0;
  double angle = ay <= ax ? unit_atan(ay / ax) : kPi / 2.0 - unit_atan(ax / ay);
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

}  // namespace ghtrack::portable

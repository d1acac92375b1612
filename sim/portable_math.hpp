#pragma once

#include <cmath>
#include <cstdint>

/// Elementary functions made of IEEE 754 operations alone (+ − × ÷ and exact scalings), so that the
/// same argument gives the same bits on every CPU and with every C library; libm picks another
/// variant, with other last bits, on a processor that has fused multiply-add. Accurate to a few
/// units in the last place over the ranges that are named.
namespace ghtrack::portable {

inline constexpr double kPi = 3.141592653589793;
inline constexpr double kDegree = kPi / 180.0;  // [rad]

inline double sign(double x) { return static_cast<double>((x > 0.0) - (x < 0.0)); }
/// From 0 at x = 0 to 1 at x = 1, with rate and curvature 0 at both (Perlin 2002).
inline double smooth_step(double x) { return x * x * x * (10.0 - x * (15.0 - 6.0 * x)); }

struct SinCos {
  double sin;
  double cos;
};

/// Natural logarithm; −infinity for 0, not a number for x < 0.
double log(double x);

/// ln(1 + x), accurate for small |x|, too.
double log1p(double x);

/// e^x; 0 below −700, infinity above 709.
double exp(double x);

/// x^y for x ≥ 0.
double pow(double x, double y);

/// Sine and cosine of 2π `turns`, for any |turns| < 2^52.
SinCos sin_cos_of_turns(double turns);

/// Sine and cosine of an angle [rad]; the error grows as |angle| × 1e-16.
SinCos sin_cos(double angle);

/// Angle of the vector (x, y) in (−π, π] [rad]; 0 for the null vector.
double atan2(double y, double x);

}  // namespace ghtrack::portable

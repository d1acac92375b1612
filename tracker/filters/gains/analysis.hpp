#pragma once

#include <complex>
#include <optional>
#include <string_view>
#include <vector>

#include "tracker/filters/gains/gains.hpp"

// What a set of gains does, in closed form. The truth is assumed to follow the filter's
// polynomial; measurement errors are independent with variance σ², the step is T.

namespace ghtrack {

/// The stability condition that the gains break, such as "2g + h < 4"; nothing if they are stable.
///   order 0: 0 < g < 2;  order 1: g > 0, h > 0, 2g + h < 4;
///   order 2: 0 < g < 2, 2g + h < 4, 0 < k < g h / (2 − g)  (Jury; Tenne & Singh 2002)
std::optional<std::string_view> violated_inequality(const Gains& gains);
inline bool is_stable(const Gains& gains) { return !violated_inequality(gains); }

/// Roots of the characteristic polynomial: order + 1 numbers, the largest magnitude first.
std::vector<std::complex<double>> poles(const Gains& gains);

/// Under: a complex pair rings. Critical: all poles equal. Over: real positive poles.
/// Alternating: real poles, one of them negative, so that the error changes sign at every sample.
enum class Damping { kUnder, kCritical, kOver, kAlternating };
std::string_view to_string(Damping damping);
Damping damping(const Gains& gains);

/// ζ of the slowest pole pair: −ln|z| / √(ln²|z| + arg² z); 1 for a positive real pole.
double damping_ratio(const Gains& gains);

/// Error variances in the steady state, as multiples of σ². Only for stable gains. @ingroup gains
struct VarianceReduction {
  double x = 0.0;
  double dx = 0.0;          // [1/s²]
  double ddx = 0.0;         // [1/s⁴]
  double prediction = 0.0;  // of the predicted position
  double x_dx = 0.0;        // covariance of position and velocity [1/s]
};

/// Order 1: Asquith 1969; order 2: Mahafza 2000, eq. 9.118–9.120, with γ = 2k.
/// @throws std::invalid_argument for unstable gains @ingroup gains
VarianceReduction variance_reduction(const Gains& gains, double dt);

/// Variance of the residual: σ² (1 + prediction).
double innovation_variance(const Gains& gains, double sigma, double dt);

/// Steady error truth − estimate without noise. @ingroup gains
struct Lag {
  double prediction = 0.0;
  double x = 0.0;
  double dx = 0.0;
  double ddx = 0.0;
};

/// Lag when the first derivative that the filter does not carry is constant: a velocity for order
/// 0, an acceleration for order 1, a jerk for order 2. @throws std::invalid_argument if unstable
Lag steady_lag(const Gains& gains, double dt, double next_derivative);

/// √(σ² VRF + lag²) of the filtered position on one axis.
double predicted_rmse(const Gains& gains, double sigma, double dt, double next_derivative);

/// Σ (error of the predicted position)² after a unit error, without noise. @ingroup gains
struct TransientEnergy {
  double position = 0.0;
  double velocity = 0.0;      // per (unit of velocity)² [s²]
  double acceleration = 0.0;  // per (unit of acceleration)² [s⁴]
};
/// @throws std::invalid_argument for unstable gains
TransientEnergy transient_energy(const Gains& gains, double dt);

/// Updates until a transient has shrunk to `fraction`, judged by the slowest pole.
/// @throws std::invalid_argument for unstable gains
double settling_updates(const Gains& gains, double fraction = 0.02);

}  // namespace ghtrack

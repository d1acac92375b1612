#pragma once

#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gains/gains.hpp"

namespace ghtrack {

/// White noise in the velocity, the acceleration and the jerk of a motion on one axis, as spectral
/// densities. It knows of no scans: what it adds over a time is the same however the time is cut.
struct NoiseDensities {
  double velocity = 0.0;      // [m²/s]
  double acceleration = 0.0;  // [m²/s³]
  double jerk = 0.0;          // [m²/s⁵]

  /// Covariance that it adds in dt seconds to a motion without acceleration (order 1 or less) or
  /// with one (order 2).
  AxisCovariance<double> over(double dt) const;
};

/// The process noise for which given gains are the best ones: that of the Kalman filter which
/// settles at them, with measurement error σ and an update every T. It says what the gains mean at
/// other intervals and for other sensors.
///
/// With S = 1 / (1 − g), Γ = 2k and everything in units of σ and T, the steady Riccati equation
/// P' = F (P' − K Kᵀ S) Fᵀ + Q has exactly one solution for a Q of white noises:
///   jerk          Γ² S
///   acceleration  (h² − 2 g Γ) S
///   velocity      g² S − 2h − Γ − P_vv − P_va − P_aa/4 − q_acceleration/3 − q_jerk/20
/// For gains that ring more than any Kalman filter would (for order 1 h above
/// 3(2 − g) − √(3(g² − 12 g + 12))) a density would be negative; it is taken as none, which leaves
/// a filter that answers manoeuvres as quickly.
/// @param gains  stable
/// @param sigma  [m], > 0
/// @param dt     T [s], > 0
NoiseDensities implied_noise(const Gains& gains, double sigma, double dt);

/// Error covariance after an update of the Kalman filter that has settled with this noise.
AxisCovariance<double> steady_covariance(const NoiseDensities& noise, int order, double sigma,
                                         double dt);

}  // namespace ghtrack

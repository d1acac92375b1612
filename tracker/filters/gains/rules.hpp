#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "tracker/filters/gains/gains.hpp"

// Rules that turn one number into a set of gains. Each throws std::invalid_argument when its
// argument lies outside the stated range.

namespace ghtrack {

/// How the target's motion departs from the polynomial that the filter assumes.
enum class ProcessModel {
  kPiecewiseConstant,  // the next derivative is random, constant between two scans
  kRandomWalk,         // the highest derivative jumps at each scan
  kWhiteNoise,         // the next derivative is continuous white noise
};
constexpr std::array<std::pair<std::string_view, ProcessModel>, 3> enum_names(ProcessModel) {
  return {{{"piecewise-constant", ProcessModel::kPiecewiseConstant},
           {"random-walk", ProcessModel::kRandomWalk},
           {"white-noise", ProcessModel::kWhiteNoise}}};
}

/// Least squares over all n measurements so far, n = 1, 2, … (Zarchan & Musoff, Fundamentals of
/// Kalman Filtering). Below order + 1 measurements the values only carry the recursion on.
/// @param order  0, 1 or 2 @ingroup gains
Gains growing_memory_gains(int order, int n);

/// The n-th gains of a filter that starts at its first measurement: for n ≤ order the polynomial
/// through the points seen so far, growing memory after that.
Gains start_up_gains(int order, int n);

/// Exponentially discounted least squares: all poles at θ. The same gains are called critically
/// damped. @param theta  in [0, 1]; 0 follows the measurements, 1 ignores them @ingroup gains
Gains fading_memory_gains(int order, double theta);

/// h = g² / (2 − g), the best compromise of noise and velocity steps (Benedict & Bordner 1962).
/// @param g  in (0, 1] @ingroup gains
Gains benedict_bordner_gains(double g);

/// The three-gain counterpart: the minimiser of noise and acceleration steps at a given g,
/// h = 2(2 − g) − 4√(1 − g), k = h² / 4g (Simpson 1963, Neal 1967; the triple is Kalata's).
/// @param g  in (0, 1]
Gains third_order_benedict_bordner_gains(double g);

/// The gains published as the optimum of Polge & Bhagavan. They satisfy 2h = g (g + h + k), but
/// third_order_benedict_bordner_gains() has the lower cost at the same g.
/// @param g  in (0, 1)
Gains polge_bhagavan_gains(double g);

/// h = 2 − g − 2√(1 − g): two equal poles. @param g  in (0, 1]
Gains critically_damped_gains(double g);

/// λ = σ_w T² / σ: how far the process noise moves the target in one step, in units of the
/// measurement's 1-sigma error (Kalata 1984).
constexpr double tracking_index(double process_noise, double sigma, double dt) {
  return process_noise * dt * dt / sigma;
}

/// Steady gains of the Kalman filter with tracking index λ (Kalata 1984; Gray & Murray 1993).
/// For ProcessModel::kRandomWalk λ² = q T² / R with q the variance of a velocity jump, for
/// kWhiteNoise λ² = q T³ / R with q the spectral density. Orders 0 and 2 know the first two
/// models, which give them the same gains.
/// @param index  λ ≥ 0 @ingroup gains
Gains tracking_index_gains(int order, double index,
                           ProcessModel model = ProcessModel::kPiecewiseConstant);

/// The λ for which a g-h pair on Kalata's curve is optimal: h / √(1 − g). @param gains  g < 1
double implied_tracking_index(const Gains& gains);

/// The g-h pair on Kalata's curve with the smallest √(noise² + lag²) in position under a lasting
/// acceleration A (Blair 2008). @param deviation  A T² / σ > 0
Gains maximum_acceleration_gains(double deviation);

}  // namespace ghtrack

#pragma once

#include <cmath>
#include <numbers>

namespace ghtrack {

/// A normal distribution over one variable.
struct Gaussian {
  double mean = 0.0;
  double variance = 1.0;

  friend constexpr bool operator==(const Gaussian&, const Gaussian&) = default;
};

/// Distribution of the sum of two independent variables.
constexpr Gaussian sum(const Gaussian& a, const Gaussian& b) {
  return {a.mean + b.mean, a.variance + b.variance};
}

/// Normalised product of two densities: two independent opinions on one variable. Two certain ones
/// (variances 0) have no product: the result is not a number.
constexpr Gaussian product(const Gaussian& a, const Gaussian& b) {
  const double total = a.variance + b.variance;
  return {(a.variance * b.mean + b.variance * a.mean) / total, a.variance * b.variance / total};
}

/// How the variable of a one-dimensional Kalman filter moves in one step: x = F x + u + w.
struct Transition {
  double control = 0.0;           // u
  double process_variance = 0.0;  // Q, variance of w
  double factor = 1.0;            // F
  double fading = 1.0;            // α ≥ 1 weighs old knowledge less: P = α² F² P + Q
};

/// x' = F x + u, P' = α² F² P + Q.
constexpr Gaussian predicted(const Gaussian& belief, const Transition& step) {
  const double growth = step.fading * step.factor;
  return {step.factor * belief.mean + step.control,
          growth * growth * belief.variance + step.process_variance};
}

/// One correction of a one-dimensional Kalman filter.
struct GaussianUpdate {
  Gaussian posterior;
  double residual = 0.0;             // y = z − x'
  double innovation_variance = 0.0;  // S = P' + R
  double gain = 0.0;                 // K = P' / S
  double nis = 0.0;                  // y² / S
  double log_likelihood = 0.0;       // ln N(y; 0, S)
};

/// x = x' + K y, P = (1 − K)² P' + K² R.
/// @param variance  R of the measurement; P' + R must be positive
inline GaussianUpdate updated(const Gaussian& prior, double z, double variance) {
  const double residual = z - prior.mean;
  const double s = prior.variance + variance;
  const double gain = prior.variance / s;
  const double keep = 1.0 - gain;
  const double nis = residual * residual / s;
  return {.posterior = {prior.mean + gain * residual,
                        keep * keep * prior.variance + gain * gain * variance},
          .residual = residual,
          .innovation_variance = s,
          .gain = gain,
          .nis = nis,
          .log_likelihood = -0.5 * (std::log(2.0 * std::numbers::pi * s) + nis)};
}

}  // namespace ghtrack

#pragma once

#include <cmath>
#include <optional>

#include "tracker/filters/gaussian.hpp"
#include "tracker/filters/kinematics.hpp"

namespace ghtrack {

/// The one-dimensional Kalman filter of a belief N(mean, variance) about one variable, which moves
/// by a known amount and some noise at every step: sums and products of Gaussians.
class ScalarKalmanFilter {
 public:
  using Vector = Kinematics<1>::Vector;

  /// @param noise  variance of a measurement
  ScalarKalmanFilter(const Gaussian& belief, const Transition& step, double noise)
      : belief_(belief), step_(step), noise_(noise) {
    prior_.position[0] = estimate_.position[0] = belief.mean;
  }

  /// Believes the first measurement as far as it can be.
  bool start(const Vector& z) {
    if (!std::isfinite(z[0])) {
      ++refusals_.measurements;
      return false;
    }
    believe({z[0], noise_});
    prior_ = estimate_;
    return true;
  }

  /// One step, whatever its length. @returns false if refused
  bool predict(double dt) {
    const Gaussian next = predicted(belief_, step_);
    if (!(dt > 0.0) || !std::isfinite(dt) || !std::isfinite(next.mean)) {
      ++refusals_.times;
      return false;
    }
    believe(next);
    prior_ = estimate_;
    residual_.reset();
    return true;
  }

  /// @returns false if refused
  bool update(const Vector& z) {
    const GaussianUpdate next = updated(belief_, z[0], noise_);
    if (!std::isfinite(next.posterior.mean)) {
      ++refusals_.measurements;
      return false;
    }
    prior_ = estimate_;
    residual_ = Vector(next.residual);
    believe(next.posterior);
    return true;
  }

  /// Says that there is no measurement for this prediction.
  void coast() { residual_.reset(); }

  const Gaussian& belief() const { return belief_; }
  const Kinematics<1>& prior() const { return prior_; }
  const Kinematics<1>& estimate() const { return estimate_; }
  const std::optional<Vector>& residual() const { return residual_; }
  const Refusals& refusals() const { return refusals_; }

 private:
  void believe(const Gaussian& belief) {
    belief_ = belief;
    estimate_.position[0] = belief.mean;
  }

  Gaussian belief_;
  Transition step_;
  double noise_;
  Kinematics<1> prior_;
  Kinematics<1> estimate_;
  std::optional<Vector> residual_;
  Refusals refusals_;
};

}  // namespace ghtrack

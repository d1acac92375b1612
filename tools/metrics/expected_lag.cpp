#include "tools/metrics/expected_lag.hpp"

namespace ghtrack {

void ExpectedLag::start(const TruthState& truth, double time) {
  estimate_ = {truth.position, truth.velocity, truth.acceleration};
  time_ = time;
}

ExpectedLag::Value ExpectedLag::advance(const TruthState& truth, double time,
                                        const DesignedStep& step, bool measured) {
  if (step.gains.order < 2) estimate_.acceleration.setZero();
  if (step.gains.order < 1) estimate_.velocity.setZero();
  const double dt = time - time_;
  time_ = time;
  if (dt > 0.0) estimate_ = extrapolated(estimate_, dt);
  const Vec2 residual = truth.position - estimate_.position;
  if (measured) estimate_ = corrected(estimate_, residual, step.gains, step.interval);
  return {truth.position - estimate_.position, truth.velocity - estimate_.velocity, residual};
}

}  // namespace ghtrack

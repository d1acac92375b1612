#include "tools/metrics/expected_lag.hpp"

namespace ghtrack {

ExpectedLag::ExpectedLag(const TruthState& truth, double time) : time_(time) {
  estimate_.position = truth.position;
  value_.velocity = truth.velocity;
}

void ExpectedLag::advance(const TruthState& truth, double time, const DesignedStep& step,
                          bool measured) {
  if (time > time_) estimate_ = extrapolated(estimate_, time - time_);
  time_ = time;
  const Vec2 residual = truth.position - estimate_.position;
  if (measured) estimate_ = corrected(estimate_, residual, step.gains, step.interval);
  value_ = {truth.position - estimate_.position, truth.velocity - estimate_.velocity, residual};
}

}  // namespace ghtrack

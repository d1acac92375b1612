#include "tracker/boxes/box_filter.hpp"

#include <cmath>

namespace ghtrack {
namespace {

constexpr double kLastingErrors = 1.5;

}  // namespace

bool BoxEstimate::is_finite() const {
  return box.centre.allFinite() && box.size.allFinite() && box.size.minCoeff() > 0.0 &&
         velocity.allFinite() && std::isfinite(motion.xx) && std::isfinite(box.area()) &&
         box.area() > 0.0;
}

BoxEstimate begin_estimate(const BoxNoise& noise, const BoundingBox& seen) {
  BoxEstimate estimate{.box = seen, .size_variance = noise.size};
  estimate.motion.xx = noise.place;
  estimate.motion.vv = noise.velocity;
  return estimate;
}

void predict(const BoxNoise& noise, const AxisCovariance<double>& spread, double dt,
             BoxEstimate& estimate) {
  estimate.box.centre += dt * estimate.velocity;
  estimate.motion = extrapolated(estimate.motion, dt);
  estimate.motion += spread;
  estimate.size_variance += noise.size_drift * dt;
}

BoxResidual residual(const BoxNoise& noise, const BoxEstimate& estimate, const BoundingBox& seen) {
  BoxResidual result;
  result.place = seen.centre - estimate.box.centre;
  result.size = (seen.size - estimate.box.size).cwiseQuotient(estimate.box.size);
  result.place_distance =
      result.place.squaredNorm() / (estimate.box.area() * (estimate.motion.xx + noise.place));
  result.size_distance = result.size.squaredNorm() / (estimate.size_variance + noise.size);
  return result;
}

void correct(const BoxNoise& noise, const BoxResidual& residual, BoxEstimate& estimate) {
  const double lasting = kLastingErrors * noise.place;
  const double error = noise.usual * lasting;
  const AxisGain<double> gain{estimate.motion.xx / (estimate.motion.xx + error),
                              estimate.motion.xv / (estimate.motion.xx + lasting), 0.0};
  estimate.box.centre += gain.x * residual.place;
  estimate.velocity += gain.v * residual.place;
  estimate.motion = corrected(estimate.motion, gain, error);

  const double size_gain =
      estimate.size_variance / (estimate.size_variance + noise.usual * noise.size);
  estimate.box.size += size_gain * estimate.box.size.cwiseProduct(residual.size);
  estimate.size_variance *= 1.0 - size_gain;
}

}  // namespace ghtrack

#include "sensors/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kShortestRange = 1e-9;  // [m]; nearer there is no bearing

PredictedMeasurement predict(const PositionModel&, const Vector2d& position, const Vector2d&) {
  PredictedMeasurement p{position, {}};
  p.jacobian.setIdentity(2, 4);
  return p;
}

PredictedMeasurement predict(const RangeBearingModel& radar, const Vector2d& position,
                             const Vector2d&) {
  const Vector2d offset = position - radar.site;
  const double range = std::max(offset.norm(), kShortestRange);
  const Vector2d along = offset / range;
  PredictedMeasurement p{Vector2d(range, portable::atan2(offset.y(), offset.x())), {}};
  p.jacobian.setZero(2, 4);
  p.jacobian.block<1, 2>(0, 0) = along.transpose();
  p.jacobian.block<1, 2>(1, 0) << -along.y() / range, along.x() / range;
  return p;
}

PredictedMeasurement predict(const RangeBearingRateModel& radar, const Vector2d& position,
                             const Vector2d& velocity) {
  const PredictedMeasurement place = predict(RangeBearingModel{radar.site}, position, velocity);
  const Vector2d along = place.jacobian.block<1, 2>(0, 0).transpose();
  const double rate = along.dot(velocity);
  PredictedMeasurement p{Eigen::Vector3d(place.z[0], place.z[1], rate), {}};
  p.jacobian.setZero(3, 4);
  p.jacobian.topRows<2>() = place.jacobian;
  p.jacobian.block<1, 2>(2, 0) = ((velocity - rate * along) / place.z[0]).transpose();
  p.jacobian.block<1, 2>(2, 2) = along.transpose();
  return p;
}

PredictedMeasurement predict(const PixelModel& camera, const Vector2d& position, const Vector2d&) {
  const Eigen::Matrix3d& h = camera.homography;
  const Eigen::Vector3d image = h * Eigen::Vector3d(position.x(), position.y(), 1.0);
  const Vector2d pixel = image.head<2>() / image.z();
  PredictedMeasurement p{pixel, {}};
  p.jacobian.setZero(2, 4);
  p.jacobian.leftCols<2>() =
      (h.topLeftCorner<2, 2>() - pixel * h.bottomLeftCorner<1, 2>()) / image.z();
  return p;
}

}  // namespace

PredictedMeasurement predicted(const MeasurementModel& model, const Vector2d& position,
                               const Vector2d& velocity) {
  return std::visit([&](const auto& kind) { return predict(kind, position, velocity); }, model);
}

MeasuredVector residual(const MeasurementModel& model, const MeasuredVector& z,
                        const MeasuredVector& predicted) {
  MeasuredVector r = z - predicted;
  const bool has_bearing = std::holds_alternative<RangeBearingModel>(model) ||
                           std::holds_alternative<RangeBearingRateModel>(model);
  if (has_bearing) r[1] = std::remainder(r[1], 2.0 * std::numbers::pi);
  return r;
}

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

namespace ghtrack {

// What sensors measure, as a function h of a target's position and velocity in the plane.

/// The position itself [m].
struct PositionModel {};

/// Distance [m] and bearing [rad], counter-clockwise from x, seen from a site.
struct RangeBearingModel {
  Eigen::Vector2d site = Eigen::Vector2d::Zero();  // [m]
};

/// The same with the growth of the distance [m/s], as a Doppler radar measures it.
struct RangeBearingRateModel {
  Eigen::Vector2d site = Eigen::Vector2d::Zero();  // [m]
};

/// Where the position appears in an image [px]: a plane seen through a lens without distortion is
/// a homography, (u w, v w, w)ᵀ = H (x, y, 1)ᵀ.
struct PixelModel {
  Eigen::Matrix3d homography = Eigen::Matrix3d::Identity();
};

using MeasurementModel =
    std::variant<PositionModel, RangeBearingModel, RangeBearingRateModel, PixelModel>;

/// Up to three numbers that a sensor measured, and the covariance of their errors.
using MeasuredVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
using MeasuredCovariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

/// z = h(position, velocity) + error, error ~ N(0, R).
struct Measurement {
  MeasuredVector z;
  MeasuredCovariance r;
  MeasurementModel model;
};

/// h and its derivative by (x, y, v_x, v_y).
struct PredictedMeasurement {
  MeasuredVector z;
  Eigen::Matrix<double, Eigen::Dynamic, 4, 0, 3, 4> jacobian;
};
PredictedMeasurement predicted(const MeasurementModel& model, const Eigen::Vector2d& position,
                               const Eigen::Vector2d& velocity);

/// z − h, a bearing the short way round.
MeasuredVector residual(const MeasurementModel& model, const MeasuredVector& z,
                        const MeasuredVector& predicted);

}  // namespace ghtrack

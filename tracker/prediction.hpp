#pragma once

#include <Eigen/Core>

namespace ghtrack {

/// Where a track expects its next detection, without the error of the sensor. @ingroup association
struct Prediction {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    // [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the predicted position [m²]
};

/// What a tracker needs of a detection, side by side in memory with its neighbours.
struct PlacedDetection {
  Eigen::Vector2d position;    // [m]
  Eigen::Matrix2d covariance;  // of its error [m²]
  int detection;               // index in the scan
};

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace ghtrack {

/// One report of a sensor: something seems to be here. It carries no identity.
struct Detection {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();      // world frame [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  // of the position's error [m²]
  std::string label;  // the reported class, such as "ball"; empty if the sensor says nothing
};

/// All detections of one sensor at one instant: all that a tracker may see.
/// The order of the detections carries no information.
struct Scan {
  double time = 0.0;  // [s] since the scene's start
  int sensor = 0;     // index into the scene's list of sensors
  std::vector<Detection> detections;
};

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "sensors/field_of_view.hpp"
#include "sensors/measurement.hpp"

namespace ghtrack {

/// One report of a sensor: something seems to be here. It carries no identity.
struct Detection {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();        // world frame [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  // of the position's error [m²]
  std::string label;  // the reported class, such as "ball"; empty if the sensor says nothing
  std::optional<Measurement> measured = {};  // what the position comes from, if it is not measured
};

/// All detections of one sensor at one instant: all that a tracker may see.
/// The order of the detections carries no information.
struct Scan {
  double time = 0.0;  // [s] since the scene's start
  int sensor = 0;     // index into the list of sensors
  std::vector<Detection> detections;
};

/// What a tracker may know of a sensor beforehand: its data sheet.
struct SensorTraits {
  double period = 1.0;  // time between scans [s]
  double sigma = 1.0;   // typical 1-sigma position error per axis [m]; filters are designed for it
  FieldOfView field_of_view;  // world frame
};

}  // namespace ghtrack

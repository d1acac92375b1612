#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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

/// What one scan of a sensor covers.
enum class Coverage {
  kWhole,    // all of its field of view: what it does not report was missed
  kPartial,  // a part that it does not tell, such as one object of many: what it does not report
             // was missed only when it should have been looked at again
};

constexpr std::array<std::pair<std::string_view, Coverage>, 2> enum_names(Coverage) {
  return {{{"whole", Coverage::kWhole}, {"partial", Coverage::kPartial}}};
}

/// What a tracker may know of a sensor beforehand: its data sheet.
struct SensorTraits {
  double period = 1.0;  // time between two looks at the same place [s]
  double sigma = 1.0;   // typical 1-sigma position error per axis [m]; filters are designed for it
  FieldOfView field_of_view;           // world frame
  double detection_probability = 0.9;  // of a target in view, in one look
  double clutter = 0.0;                // expected false detections in one look at all of the view
  Coverage coverage = Coverage::kWhole;
};

}  // namespace ghtrack

#pragma once

#include <optional>
#include <vector>

#include "sensors/sensor.hpp"

namespace ghtrack {

/// A part of a sensor's errors that is normally distributed.
struct ErrorPart {
  double probability = 1.0;
  double variance_factor = 1.0;  // of the covariance that detections tell
};

/// Errors of a sensor as a mixture of normal ones: outliers are wider, and Student's t is a mixture
/// over all widths, of which a few stand for the rest. Nothing if they have no variance, as with
/// two degrees of freedom or fewer.
std::optional<std::vector<ErrorPart>> error_parts(const SensorConfig& sensor);

/// What a sensor measures on average of an object at this place, with its bias: a detection without
/// noise. Nothing if it cannot be measured.
std::optional<Detection> noiseless_detection(const SensorConfig& sensor, const Vec2& place);

}  // namespace ghtrack

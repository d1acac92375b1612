#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
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

/// Whether the errors of a sensor are normally distributed: no outliers, no heavy tails, no
/// rounding to cells that are large beside the noise. @param errors  of the sensor
bool is_normal(const SensorConfig& sensor, std::span<const ErrorPart> errors);

/// A detection of an object at this place without noise, with the sensor's bias, and not rounded.
/// Nothing if it cannot be measured.
std::optional<Detection> noiseless_detection(const SensorConfig& sensor, const Vec2& place);

/// What a sensor measures of an object at a place, over all noise.
struct ExpectedMeasurement {
  Detection mean;              // tells the accuracy that its detections tell
  Eigen::Matrix2d covariance;  // that they have [m²]
};

/// The mean has the sensor's bias, and what rounding makes of the place: where the noise is small
/// beside a cell, an object that stands still is in the same one again and again.
/// @param errors  of the sensor
/// @param told    a detection of an object there, for the accuracy that it tells
/// @return nothing if it cannot be measured
std::optional<ExpectedMeasurement> expected_measurement(const SensorConfig& sensor,
                                                        std::span<const ErrorPart> errors,
                                                        const Vec2& place, const Detection& told);

}  // namespace ghtrack

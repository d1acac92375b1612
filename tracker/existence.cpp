#include "tracker/existence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

// A target that leaves the model of its filter for a moment is missed, however good the sensor is.
constexpr double kSurestDetection = 0.95;
constexpr double kLeastDetection = 0.01;
constexpr double kScansOfALife = 200.0;
constexpr double kTargetsAtFirst = 0.3;  // for each false detection in a scan

/// The density of false detections where none are known: this many in the area 2 π σ² of a
/// detection's error.
constexpr double kFewFalseDetections = 1e-5;

double surveyed_area(const SensorTraits& sensor, double otherwise) {
  const double shape = area(sensor.field_of_view);
  return std::isfinite(shape) ? shape : otherwise;
}

/// What is known counts as it is, however small beside the error of a detection: of a fast target's
/// first steps nothing but the density of false detections tells whether they are its own.
double clutter_density(const SensorTraits& sensor, double area) {
  const double known = sensor.clutter / surveyed_area(sensor, area);
  if (known > 0.0) return known;
  return kFewFalseDetections / (2.0 * std::numbers::pi * sensor.sigma * sensor.sigma);
}

}  // namespace

double survival(double elapsed, double lifetime) { return portable::exp(-elapsed / lifetime); }

Evidence::Evidence(const ExistenceConfig& config, const SensorTraits& sensor, double otherwise)
    : detection_probability(
          std::clamp(sensor.detection_probability, kLeastDetection, kSurestDetection)),
      clutter(clutter_density(sensor, otherwise)),
      births(config.births * clutter),
      at_first(std::max(config.births, kTargetsAtFirst) * clutter),
      lifetime(config.lifetime.value_or(kScansOfALife * sensor.period)),
      area(surveyed_area(sensor, otherwise)) {}

double Evidence::log_nobodys(double density, std::size_t detections) const {
  const double expected = std::isfinite(area) ? density * area : 0.0;
  return static_cast<double>(detections) * portable::log(density) - expected;
}

double Undetected::before_look(const Evidence& evidence, int sensor, double time) {
  const auto index = static_cast<std::size_t>(sensor);
  if (by_sensor_.size() <= index) by_sensor_.resize(index + 1);
  Seen& seen = by_sensor_[index];
  if (std::isfinite(seen.time)) {
    seen.density = evidence.births + survival(time - seen.time, evidence.lifetime) * seen.density;
  } else {
    seen.density = evidence.at_first;
  }
  seen.time = time;
  return seen.density;
}

void Undetected::after_look(const Evidence& evidence, int sensor) {
  by_sensor_[static_cast<std::size_t>(sensor)].density *= 1.0 - evidence.detection_probability;
}

}  // namespace ghtrack

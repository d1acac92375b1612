#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "sensors/field_of_view.hpp"
#include "sensors/observation.hpp"
#include "sensors/position_sensor.hpp"

namespace ghtrack {

using SensorModel = std::variant<PositionSensor>;  // add yours here

/// A sensor of a scene: when it looks, where, what it measures and how often it is wrong.
struct SensorConfig {
  static constexpr std::string_view about = "turns the truth into unlabelled detections";

  std::string name;
  double rate = 30.0;  // scans per second [Hz]
  double phase = 0.0;  // time of the first scan [s]
  double detection_probability = 1.0;
  double clutter = 0.0;             // expected false detections per scan
  double classify = 1.0;            // probability of the right class; 0: reports no class
  std::vector<Vec2> field_of_view;  // lower left and upper right corner [m]; empty: everything
  SensorModel model;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &SensorConfig::name,
            {.meaning = "unique; its noise depends on it; by default sensor 1, sensor 2, …"});
    v.field("rate", &SensorConfig::rate,
            {.unit = "Hz", .meaning = "scans per second", .above = 0.0, .maximum = 1e4});
    v.field("phase", &SensorConfig::phase,
            {.unit = "s", .meaning = "time of the first scan", .minimum = 0.0, .maximum = 1e6});
    v.field("detection_probability", &SensorConfig::detection_probability,
            {.unit = "1",
             .meaning = "chance that an object in view is detected in a scan",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("clutter", &SensorConfig::clutter,
            {.unit = "1",
             .meaning =
                 "expected false detections per scan, Poisson distributed over the field of view",
             .minimum = 0.0,
             .maximum = 1e5});
    v.field("classify", &SensorConfig::classify,
            {.unit = "1",
             .meaning = "chance that the reported class is right; 0: no class is reported",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("field_of_view", &SensorConfig::field_of_view,
            {.unit = "m",
             .meaning = "lower left and upper right corner; without it everything is seen",
             .minimum = -1e7,
             .maximum = 1e7,
             .max_items = 2});
    v.tagged("kind", &SensorConfig::model, {.meaning = "what it measures"});
  }

  template <class Report>
  void check(Report&& report) const {
    check_field_of_view(field_of_view, report);
    if (clutter > 0.0 && field_of_view.empty()) {
      report("clutter", "false detections need a field_of_view to lie in");
    }
  }
};

/// What the sensor's data sheet tells a tracker.
SensorTraits traits_of(const SensorConfig& sensor);

/// Instant of scan 0, 1, …: phase + scan / rate, never accumulated [s].
double scan_time(const SensorConfig& sensor, std::int64_t scan);

/// What a sensor reports of the truth at one scan.
///
/// Every random number is a function of (seed, sensor name, object key, scan), so that adding an
/// object or a sensor changes nothing about the others. Detections are sorted by position: their
/// order says nothing about their origin.
/// @param sensor_index  written into the scan
/// @param scan          number of the scan of this sensor
/// @param objects       the world's objects; the truth's ids are indices into it
Observation observe(const SensorConfig& sensor, int sensor_index, std::int64_t scan,
                    const TruthSnapshot& truth, const std::vector<ObjectInfo>& objects,
                    std::uint64_t seed);

}  // namespace ghtrack

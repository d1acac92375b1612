#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sensors/camera.hpp"
#include "sensors/observation.hpp"
#include "sensors/position_sensor.hpp"
#include "sensors/radar.hpp"

namespace ghtrack {

/// What a kind of sensor must offer beside its description: the geometry of what it measures. When
/// it looks, what it overlooks and what it invents is the same for all kinds: see SensorConfig.
///   view(site)                  where it sees
///   measure(truth, site, error) the detection of something at `truth`, with two independent errors
///                               of unit variance to be scaled; nothing if it cannot be measured
///   false_alarm(place, site)    a detection at `place`, with the covariance that one there has
///   typical_sigma()             1 sigma per axis that filters are designed for [m]
template <class M>
concept IsSensorModel = requires(const M& model, const Vec2& point) {
  { M::kind } -> std::convertible_to<std::string_view>;
  { model.view(point) } -> std::same_as<FieldOfView>;
  { model.measure(point, point, point) } -> std::same_as<std::optional<Detection>>;
  { model.false_alarm(point, point) } -> std::same_as<Detection>;
  { model.typical_sigma() } -> std::same_as<double>;
};

using SensorModel = std::variant<PositionSensor, Radar, Camera>;  // add yours here

template <class Variant>
inline constexpr bool all_are_sensor_models = false;
template <class... M>
inline constexpr bool all_are_sensor_models<std::variant<M...>> = (IsSensorModel<M> && ...);

static_assert(
    all_are_sensor_models<SensorModel>,
    "every alternative of SensorModel needs kind, describe() and what IsSensorModel says");

/// A sensor of a scene: when it looks, where, what it measures and how often it is wrong.
struct SensorConfig {
  static constexpr std::string_view about = "turns the truth into unlabelled detections";

  std::string name;
  double rate = 30.0;    // scans per second [Hz]
  double phase = 0.0;    // time of the first scan [s]
  double latency = 0.0;  // from a scan to its arrival at the tracker [s]
  Vec2 site = Vec2::Zero();
  double detection_probability = 1.0;
  std::optional<double> half_range;  // where the probability of detection has fallen by half [m]
  std::optional<double> half_size;   // of an object that is detected half as often [m]
  double clutter = 0.0;              // expected false detections per scan
  double classify = 1.0;             // probability of the right class; 0: reports no class
  std::optional<double> student_dof;
  double outlier_probability = 0.0;
  double outlier_scale = 10.0;
  double resolution = 0.0;          // detections closer than this become one [m]
  std::optional<double> occlusion;  // an object covered by more than this is not detected
  std::vector<std::string> nearest_first;
  SensorModel model;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &SensorConfig::name,
            {.meaning = "unique; its noise depends on it; by default sensor 1, sensor 2, …"});
    v.field("rate", &SensorConfig::rate,
            {.unit = "Hz", .meaning = "scans per second", .above = 0.0, .maximum = 1e4});
    v.field("phase", &SensorConfig::phase,
            {.unit = "s", .meaning = "time of the first scan", .minimum = 0.0, .maximum = 1e6});
    v.field("latency", &SensorConfig::latency,
            {.unit = "s",
             .meaning = "time that a scan takes to arrive at the tracker",
             .minimum = 0.0,
             .maximum = 1e3});
    v.field("site", &SensorConfig::site,
            {.unit = "m",
             .meaning = "where it stands: for a radar, and for half_range",
             .minimum = -1e7,
             .maximum = 1e7});
    v.field("detection_probability", &SensorConfig::detection_probability,
            {.unit = "1",
             .meaning = "chance that an object in view is detected in a scan",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field(
        "half_range", &SensorConfig::half_range,
        {.unit = "m",
         .meaning = "distance from the site at which that chance is halved; it falls as 2^-(r / "
                    "half_range)^4, as for a fluctuating target (Swerling 1) and a radar's "
                    "signal",
         .above = 0.0,
         .maximum = 1e7});
    v.field(
        "half_size", &SensorConfig::half_size,
        {.unit = "m",
         .meaning = "size, the root of length times width, at which that chance is halved; with "
                    "x = size / half_size it is x^E / (1 + x^E), E = 2.7 + 0.7 x (Johnson's "
                    "criteria)",
         .above = 0.0,
         .maximum = 1e4});
    v.field("clutter", &SensorConfig::clutter,
            {.unit = "1",
             .meaning =
                 "expected false detections per scan, Poisson distributed over the field of view",
             .minimum = 0.0,
             .maximum = 1e5});
    v.field("classify", &SensorConfig::classify,
            {.unit = "1",
             .meaning = "chance that the reported class is right, otherwise it is any of the other "
                        "regimes; 0: no class is reported",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("student_dof", &SensorConfig::student_dof,
            {.unit = "1",
             .meaning = "degrees of freedom of Student's t for errors with heavy tails, scaled as "
                        "the 1-sigma errors say; without it they are Gaussian",
             .minimum = 1.0,
             .maximum = 1e6});
    v.field("outlier_probability", &SensorConfig::outlier_probability,
            {.unit = "1",
             .meaning = "chance that the error of a detection is outlier_scale times as large",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("outlier_scale", &SensorConfig::outlier_scale,
            {.unit = "1",
             .meaning = "how many times larger an outlier's error is",
             .minimum = 1.0,
             .maximum = 1e4});
    v.field("resolution", &SensorConfig::resolution,
            {.unit = "m",
             .meaning = "detections closer than this become one, at their mean; 0: never",
             .minimum = 0.0,
             .maximum = 1e6});
    v.field("occlusion", &SensorConfig::occlusion,
            {.unit = "1",
             .meaning = "an object that nearer ones cover by more than this fraction is not "
                        "detected; without it objects hide nothing",
             .minimum = 0.0,
             .below = 1.0});
    v.field("nearest_first", &SensorConfig::nearest_first,
            {.meaning = "for occlusion: names of targets from the nearest on; all others are "
                        "behind, the last of the scene in front of the first"});
    v.tagged("kind", &SensorConfig::model, {.meaning = "what it measures"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (clutter > 0.0 && std::holds_alternative<Everywhere>(view())) {
      report("clutter", "false detections need a field_of_view to lie in");
    }
    if (!nearest_first.empty() && !occlusion) {
      report("nearest_first", "says nothing without 'occlusion'");
    }
  }

  FieldOfView view() const {
    return std::visit([&](const auto& kind) { return kind.view(site); }, model);
  }
};

/// What the sensor's data sheet tells a tracker.
SensorTraits traits_of(const SensorConfig& sensor);
std::vector<SensorTraits> traits_of(const std::vector<SensorConfig>& sensors);

/// Instant of scan 0, 1, …: phase + scan / rate, never accumulated [s].
double scan_time(const SensorConfig& sensor, std::int64_t scan);

/// What stays the same during a run.
struct Setting {
  std::vector<ObjectInfo> objects;   // the truth's ids are indices into it
  std::vector<std::string> classes;  // that a detector can report, in a fixed order
  std::uint64_t seed = 1;
};

/// What a sensor reports of the truth at one scan.
///
/// Every random number is a function of (seed, sensor name, object key, scan), so that adding an
/// object or a sensor changes nothing about the others, except where one hides or merges with
/// another. Detections are sorted by position: their order says nothing about their origin.
/// @param sensor_index  written into the scan
/// @param scan          number of the scan of this sensor
Observation observe(const SensorConfig& sensor, int sensor_index, std::int64_t scan,
                    const TruthSnapshot& truth, const Setting& setting);

}  // namespace ghtrack

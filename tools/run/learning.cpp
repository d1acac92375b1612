#include "tools/run/learning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

#include "tracker/learning/coverage.hpp"

namespace ghtrack {
namespace {

/// Enough to learn from: many scans of a few objects, or some of many.
constexpr std::size_t kManyScans = 100, kSomeScans = 25;
constexpr std::size_t kEnoughDetections = 20000, kManyDetections = 50000;
constexpr int kMostMissing = 20;  // scans in a row

std::vector<Scan> excerpt_of(const ScanSource& source) {
  std::vector<Scan> scans;
  std::size_t detections = 0;
  for (Scan scan; source.next(scan);) {
    detections += scan.detections.size();
    scans.push_back(std::move(scan));
    if (scans.size() >= kManyScans && detections >= kEnoughDetections) break;
    if (scans.size() >= kSomeScans && detections >= kManyDetections) break;
    scan = {};
  }
  return scans;
}

/// Median time between scans of a sensor at different instants [s].
std::optional<double> median_interval(const std::vector<const Scan*>& scans) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double interval = scans[i]->time - scans[i - 1]->time;
    if (interval > 0.0) intervals.push_back(interval);
  }
  if (intervals.empty()) return std::nullopt;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

/// What is said of each sensor, with the times that its scans show.
std::vector<OfflineSensor> sensors_of(const OfflineConfig& config, const ScanSource& source,
                                      const std::vector<Scan>& scans) {
  std::vector<OfflineSensor> sensors;
  for (std::size_t s = 0; s < source.sensors.size(); ++s) {
    OfflineSensor& sensor = sensors.emplace_back(config.sensor(source.sensors[s]));
    std::vector<const Scan*> own;
    for (const Scan& scan : scans) {
      if (scan.sensor == static_cast<int>(s)) own.push_back(&scan);
    }
    if (!sensor.scan) {
      const std::optional<double> revisit = revisit_time(own);
      sensor.scan = revisit ? Coverage::kPartial : Coverage::kWhole;
      if (revisit && sensor.period == 0.0) sensor.period = *revisit;
    }
    if (sensor.period > 0.0) continue;
    const double usual = source.period > 0.0 ? source.period : 1.0;
    sensor.period = median_interval(own).value_or(usual);
  }
  return sensors;
}

std::vector<Scan> with_missing(const std::vector<Scan>& scans,
                               const std::vector<OfflineSensor>& sensors) {
  std::vector<SensorTraits> traits;
  for (const OfflineSensor& sensor : sensors) traits.push_back(traits_of(sensor, sensor.period));
  MissingScans missing(std::move(traits));
  std::vector<Scan> all;
  for (const Scan& scan : scans) {
    int in_a_row = 0;
    missing.fill(scan, [&](const Scan& empty) {
      all.push_back(empty);
      return ++in_a_row < kMostMissing;
    });
    all.push_back(scan);
  }
  return all;
}

SensorSaid said_of(const OfflineSensor& sensor) {
  SensorSaid said{.period = sensor.period,
                  .noise = {},
                  .field_of_view = rectangle_between(sensor.field_of_view),
                  .detection_probability = sensor.detection_probability,
                  .clutter = sensor.clutter};
  if (sensor.noise) said.noise = noise_of(sensor);
  said.area = sensor.area.value_or(said.area);
  said.coverage = *sensor.scan;
  return said;
}

/// "0.98 (0.91 … 1.05)"; what nothing could be learned of is supposed.
std::string text(const Learned& learned) {
  if (learned.is_given) return fmt::format("{:.3g} (given)", learned.value);
  if (!(learned.high > learned.low)) return fmt::format("{:.3g} (supposed)", learned.value);
  return fmt::format("{:.3g} ({:.3g} … {:.3g})", learned.value, learned.low, learned.high);
}

std::string filter_text(const FilterConfig& filter) {
  return std::visit([](const auto& f) { return std::string(f.kind); }, filter);
}

std::string sensor_text(const LearnedSensor& sensor, const std::string& name) {
  const SensorTraits& traits = sensor.traits;
  std::string line =
      fmt::format("sensor{}{}: noise {} along x, {} along y", name.empty() ? "" : " ", name,
                  text(sensor.noise.x), text(sensor.noise.y));
  line += fmt::format("; detection probability {}; {} false detections a scan",
                      text(sensor.detection_probability), text(sensor.clutter));
  line += traits.coverage == Coverage::kPartial
              ? fmt::format("; one object at a time, each every {:.4g} s", traits.period)
              : fmt::format("; a scan shows all, every {:.4g} s", traits.period);
  return line;
}

}  // namespace

bool leaves_open(const OfflineConfig& config, const std::vector<std::string>& sensors,
                 bool has_sigma) {
  if (config.tracker.filters.empty()) return true;
  return std::any_of(sensors.begin(), sensors.end(), [&](const std::string& name) {
    const OfflineSensor sensor = config.sensor(name);
    if (!sensor.noise && !has_sigma) return true;
    return config.tracker.lives_by() == LifeCycle::kExistence &&
           !(sensor.detection_probability && sensor.clutter);
  });
}

LearnedConfig learn_offline(const OfflineConfig& config, const ScanSource& source) {
  const std::vector<Scan> excerpt = excerpt_of(source);
  std::vector<OfflineSensor> sensors = sensors_of(config, source, excerpt);
  std::vector<SensorSaid> said;
  for (const OfflineSensor& sensor : sensors) said.push_back(said_of(sensor));
  LearnedConfig result{.config = config,
                       .learned = learn(config.tracker, said, with_missing(excerpt, sensors)),
                       .sensors = source.sensors};
  result.config.tracker = result.learned.config;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    OfflineSensor& sensor = sensors[s];
    const LearnedSensor& learned = result.learned.sensors[s];
    sensor.noise = learned.noise.x.value;
    sensor.noise_y = learned.noise.y.value;
    sensor.detection_probability = learned.detection_probability.value;
    sensor.clutter = learned.clutter.value;
    if (sensor.field_of_view.empty()) sensor.area = learned.area;
    if (sensors.size() > 1 || !source.sensors[s].empty()) {
      result.config.sensors[source.sensors[s]] = sensor;
    } else {
      static_cast<OfflineSensor&>(result.config) = sensor;
    }
  }
  return result;
}

std::vector<std::string> describe(const LearnedConfig& result) {
  const LearnedTracker& learned = result.learned;
  std::vector<std::string> lines;
  lines.push_back(fmt::format(
      "learned from {} scan{} in {} pass{}: {} track{} explain{} {:.0f} % of the detections",
      learned.scans, learned.scans == 1 ? "" : "s", learned.passes, learned.passes == 1 ? "" : "es",
      learned.tracks, learned.tracks == 1 ? "" : "s", learned.tracks == 1 ? "s" : "",
      100.0 * learned.explained));
  for (std::size_t s = 0; s < learned.sensors.size(); ++s) {
    lines.push_back(sensor_text(learned.sensors[s], result.sensors[s]));
  }
  for (const auto& [label, own] : learned.classes) {
    const bool is_any = label == TrackerConfig::kDefaultFilter;
    lines.push_back(fmt::format(
        "{}{}: speed {:.3g} along each axis, process noise {}; filter {}{}",
        is_any ? "targets" : "class ", is_any ? "" : label, learned.initial_speed,
        text(own.process_density), filter_text(own.filter),
        own.gain > 0.0 ? fmt::format(", exp({:.0f}) times as likely as kalman-cv", own.gain) : ""));
  }
  return lines;
}

}  // namespace ghtrack

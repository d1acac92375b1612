#include "tools/run/offline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace ghtrack {
namespace {

/// Median time between scans at different instants [s].
double median_period(std::span<const Scan> scans) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double period = scans[i].time - scans[i - 1].time;
    if (period > 0.0) periods.push_back(period);
  }
  if (periods.empty()) return 1.0;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

}  // namespace

OfflineSensor OfflineConfig::sensor(const std::string& name) const {
  const OfflineSensor& all = *this;
  const auto found = sensors.find(name);
  if (found == sensors.end()) return all;
  OfflineSensor own = found->second;
  if (!own.noise) {
    own.noise = all.noise;
    own.noise_y = all.noise_y;
  }
  if (own.period == 0.0) own.period = all.period;
  if (own.field_of_view.empty()) own.field_of_view = all.field_of_view;
  if (!own.detection_probability) own.detection_probability = all.detection_probability;
  if (!own.clutter) own.clutter = all.clutter;
  if (!own.area) own.area = all.area;
  if (!own.scan) own.scan = all.scan;
  return own;
}

Eigen::Vector2d noise_of(const OfflineSensor& sensor) {
  const double x = sensor.noise.value_or(1.0);
  return {x, sensor.noise_y.value_or(x)};
}

double area_of(const OfflineSensor& sensor) {
  return sensor.area.value_or(std::numeric_limits<double>::infinity());
}

SensorTraits traits_of(const OfflineSensor& sensor, double period) {
  SensorTraits traits{.period = sensor.period > 0.0 ? sensor.period : period,
                      .sigma = std::sqrt(noise_of(sensor).prod()),
                      .field_of_view = rectangle_between(sensor.field_of_view),
                      .coverage = sensor.scan.value_or(Coverage::kWhole)};
  traits.detection_probability =
      sensor.detection_probability.value_or(traits.detection_probability);
  traits.clutter = sensor.clutter.value_or(traits.clutter);
  return traits;
}

MissingScans::MissingScans(std::vector<SensorTraits> sensors) {
  for (SensorTraits& traits : sensors)
    sensors_.push_back({.traits = std::move(traits), .last = {}});
}

void MissingScans::fill(const Scan& scan, const std::function<bool(const Scan&)>& process) {
  constexpr int kMostInARow = 64;  // then a sensor among others has been switched off
  const auto due = [](const Sensor& s) { return *s.last + (s.missing + 1) * s.traits.period; };
  for (bool goes_on = true; goes_on;) {
    Sensor* first = nullptr;
    for (Sensor& sensor : sensors_) {
      if (!sensor.last || sensor.traits.coverage == Coverage::kPartial) continue;
      if (sensors_.size() > 1 && sensor.missing >= kMostInARow) continue;
      if (due(sensor) > scan.time - 0.5 * sensor.traits.period) continue;
      if (first == nullptr || due(sensor) < due(*first)) first = &sensor;
    }
    if (first == nullptr) break;
    const double time = due(*first);
    ++first->missing;
    goes_on = process(
        {.time = time, .sensor = static_cast<int>(first - sensors_.data()), .detections = {}});
  }
  Sensor& own = sensors_[static_cast<std::size_t>(scan.sensor)];
  own.last = scan.time;
  own.missing = 0;
}

TrackerState track_offline(const OfflineConfig& config, const ScanSource& scans,
                           const OnTracked& on_scan, StepTimes* times) {
  std::vector<SensorTraits> traits;
  std::vector<double> areas;
  std::vector<Eigen::Matrix2d> covariance;
  for (const std::string& name : scans.sensors) {
    const OfflineSensor sensor = config.sensor(name);
    traits.push_back(traits_of(sensor, scans.period > 0.0 ? scans.period : 1.0));
    areas.push_back(area_of(sensor));
    covariance.emplace_back(noise_of(sensor).cwiseAbs2().asDiagonal());
  }
  const TrackerDesign design(config.tracker, traits, areas);
  MissingScans missing(traits);
  TrackerState state;
  const auto process = [&](const Scan& scan) {
    state = step(design, std::move(state), scan, times);
    on_scan(snapshot(state), scan);
  };
  const auto process_missing = [&](const Scan& scan) {
    if (state.tracks.empty()) return false;
    process(scan);
    return true;
  };
  for (Scan scan; scans.next(scan);) {
    missing.fill(scan, process_missing);
    for (Detection& detection : scan.detections) {
      if (!detection.covariance.isZero(0.0)) continue;
      detection.covariance = covariance[static_cast<std::size_t>(scan.sensor)];
    }
    process(scan);
  }
  return state;
}

TrackerState track_offline(const OfflineConfig& config, std::span<const Scan> scans,
                           const OnTracked& on_scan, StepTimes* times) {
  ScanSource source{.next = {}, .period = median_period(scans)};
  for (const Scan& scan : scans) {
    const auto sensor = static_cast<std::size_t>(scan.sensor);
    if (source.sensors.size() <= sensor) source.sensors.resize(sensor + 1);
  }
  source.next = [scans, at = std::size_t{0}](Scan& scan) mutable {
    if (at == scans.size()) return false;
    scan = scans[at++];
    return true;
  };
  return track_offline(config, source, on_scan, times);
}

}  // namespace ghtrack

#include "tools/run/offline.hpp"

#include <algorithm>
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

SensorTraits traits_of(const OfflineConfig& config, double period) {
  SensorTraits traits{.period = period,
                      .sigma = config.noise,
                      .field_of_view = rectangle_between(config.field_of_view),
                      .coverage = config.scan};
  traits.detection_probability =
      config.detection_probability.value_or(traits.detection_probability);
  traits.clutter = config.clutter.value_or(traits.clutter);
  return traits;
}

TrackerState track_offline(const OfflineConfig& config, const ScanSource& scans,
                           const std::function<void(const TrackSnapshot&)>& on_scan,
                           StepTimes* times) {
  const double known = config.period > 0.0 ? config.period : scans.period;
  const double period = known > 0.0 ? known : 1.0;
  const TrackerDesign design(config.tracker, std::vector<SensorTraits>(
                                                 static_cast<std::size_t>(scans.sensors),
                                                 traits_of(config, period)));
  const Eigen::Matrix2d covariance = config.noise * config.noise * Eigen::Matrix2d::Identity();
  TrackerState state;
  const auto process = [&](const Scan& scan) {
    state = step(design, std::move(state), scan, times);
    on_scan(snapshot(state));
  };
  double last = 0.0;
  bool is_first = true;
  for (Scan scan; scans.next(scan); is_first = false) {
    const bool may_lack = !is_first && config.scan == Coverage::kWhole;
    for (int missing = 1; may_lack && !state.tracks.empty(); ++missing) {
      const double time = last + missing * period;
      if (time > scan.time - 0.5 * period) break;
      process({.time = time, .sensor = scan.sensor, .detections = {}});
    }
    for (Detection& detection : scan.detections) {
      if (detection.covariance.isZero(0.0)) detection.covariance = covariance;
    }
    process(scan);
    last = scan.time;
  }
  return state;
}

TrackerState track_offline(const OfflineConfig& config, std::span<const Scan> scans,
                           const std::function<void(const TrackSnapshot&)>& on_scan,
                           StepTimes* times) {
  ScanSource source{.next = {}, .period = median_period(scans), .sensors = 1};
  for (const Scan& scan : scans) source.sensors = std::max(source.sensors, scan.sensor + 1);
  source.next = [scans, at = std::size_t{0}](Scan& scan) mutable {
    if (at == scans.size()) return false;
    scan = scans[at++];
    return true;
  };
  return track_offline(config, source, on_scan, times);
}

}  // namespace ghtrack

#include "tools/pipeline/offline.hpp"

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

SensorTraits traits_of(const OfflineConfig& config, double period) {
  return {.period = period,
          .sigma = config.noise,
          .field_of_view = rectangle_between(config.field_of_view)};
}

}  // namespace

TrackerState track_offline(const OfflineConfig& config, std::span<const Scan> scans,
                           const std::function<void(const TrackSnapshot&)>& on_scan,
                           StepTimes* times) {
  const double period = config.period > 0.0 ? config.period : median_period(scans);
  int sensors = 1;
  for (const Scan& scan : scans) sensors = std::max(sensors, scan.sensor + 1);
  const TrackerDesign design(config.tracker,
                             std::vector<SensorTraits>(sensors, traits_of(config, period)));
  const Eigen::Matrix2d covariance = config.noise * config.noise * Eigen::Matrix2d::Identity();
  TrackerState state;
  const auto process = [&](const Scan& scan) {
    state = step(design, std::move(state), scan, times);
    on_scan(snapshot(state));
  };
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (i > 0) {
      const double last = scans[i - 1].time;
      for (int missing = 1; !state.tracks.empty(); ++missing) {
        const double time = last + missing * period;
        if (time > scans[i].time - 0.5 * period) break;
        process({.time = time, .sensor = scans[i].sensor, .detections = {}});
      }
    }
    Scan scan = scans[i];
    for (Detection& detection : scan.detections) detection.covariance = covariance;
    process(scan);
  }
  return state;
}

}  // namespace ghtrack

#include "tools/pipeline/sensing.hpp"

#include <compare>
#include <map>
#include <utility>

namespace ghtrack {
namespace {

/// The order in which scans reach the tracker.
struct ArrivalKey {
  double arrival = 0.0;
  double time = 0.0;
  int sensor = 0;
  auto operator<=>(const ArrivalKey&) const = default;
};

}  // namespace

std::optional<ScanSchedule::Entry> ScanSchedule::next() const {
  std::optional<Entry> first;
  for (std::size_t i = 0; i < next_scan_.size(); ++i) {
    const double time = scan_time(scene_.sensors[i], next_scan_[i]);
    if (time <= scene_.duration && (!first || time < first->time)) {
      first = {time, static_cast<int>(i), next_scan_[i]};
    }
  }
  return first;
}

void sense(const WorldScene& scene, const Setting& setting, const TruthSource& truth,
           const std::function<void(const SensedScan&)>& on_sensed,
           const std::function<void(SensedScan)>& on_arrival) {
  ScanSchedule schedule(scene);
  std::map<ArrivalKey, SensedScan> under_way;
  for (auto entry = schedule.next(); entry || !under_way.empty(); entry = schedule.next()) {
    if (!entry || (!under_way.empty() && under_way.begin()->first.arrival < entry->time)) {
      on_arrival(under_way.extract(under_way.begin()).mapped());
      continue;
    }
    schedule.take(*entry);
    const SensorConfig& sensor = scene.sensors[static_cast<std::size_t>(entry->sensor)];
    SensedScan scan;
    scan.truth = truth(entry->time);
    scan.observation = observe(sensor, entry->sensor, entry->scan, *scan.truth, setting);
    scan.arrival = entry->time + sensor.latency;
    on_sensed(scan);
    under_way.emplace(ArrivalKey{scan.arrival, entry->time, entry->sensor}, std::move(scan));
  }
}

}  // namespace ghtrack

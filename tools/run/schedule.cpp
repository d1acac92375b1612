#include "tools/run/schedule.hpp"

#include "sensors/sensor.hpp"

namespace ghtrack {

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

std::vector<double> scan_instants(const WorldScene& scene) {
  std::vector<double> instants;
  ScanSchedule schedule(scene);
  for (auto scan = schedule.next(); scan; scan = schedule.next()) {
    schedule.take(*scan);
    if (instants.empty() || scan->time > instants.back()) instants.push_back(scan->time);
  }
  return instants;
}

}  // namespace ghtrack

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sensors/sensor.hpp"

namespace ghtrack {

/// The scans of all sensors of a scene in the order of time, sensors of the same instant in the
/// order of the scene.
class ScanSchedule {
 public:
  explicit ScanSchedule(const WorldScene& scene)
      : scene_(scene), next_scan_(scene.sensors.size(), 0) {}

  struct Entry {
    double time = 0.0;  // [s]
    int sensor = 0;
    std::int64_t scan = 0;
  };

  /// The next scan, until take() is called; nothing at the end of the scene.
  std::optional<Entry> next() const;
  void take(const Entry& entry) { ++next_scan_[static_cast<std::size_t>(entry.sensor)]; }

 private:
  const WorldScene& scene_;
  std::vector<std::int64_t> next_scan_;  // of each sensor
};

/// A scan with the truth of its instant.
struct SensedScan {
  std::shared_ptr<const TruthSnapshot> truth;
  Observation observation;
  double arrival = 0.0;  // at the tracker: scan time + latency [s]
};

/// Where the truth at an instant comes from; the instants do not decrease from call to call.
using TruthSource = std::function<std::shared_ptr<const TruthSnapshot>(double time)>;

/// Lets the sensors of a scene look at the truth, from the scene's start to its end.
/// @param setting     its seed chooses all that sensors draw
/// @param truth       asked once per scan, in the order of the schedule
/// @param on_sensed   every scan as it is made
/// @param on_arrival  every scan when it reaches the tracker, in that order; with equal arrivals by
///                    time and sensor
void sense(const WorldScene& scene, const Setting& setting, const TruthSource& truth,
           const std::function<void(const SensedScan&)>& on_sensed,
           const std::function<void(SensedScan)>& on_arrival);

}  // namespace ghtrack

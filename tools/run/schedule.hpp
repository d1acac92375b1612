#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/schema/scene.hpp"

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

/// The instants of all scans of a scene, ascending, each once [s].
std::vector<double> scan_instants(const WorldScene& scene);

}  // namespace ghtrack

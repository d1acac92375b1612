#pragma once

#include <functional>

#include "tools/run/learning.hpp"

namespace ghtrack {

/// Tracks scans as they come, and learns from those so far what the configuration leaves open:
/// first when there are enough of them, until which nothing is said to be real, then whenever there
/// are half as many more. What has been seen lately is then tracked again, and tracks keep their
/// ids.
/// @param on_scan     is told of each scan, the missing ones included
/// @param on_learned  gets what was learned, each time
/// @return the tracker's state at the end
TrackerState track_online(const OfflineConfig& config, const ScanSource& scans,
                          const OnTracked& on_scan,
                          const std::function<void(const LearnedConfig&)>& on_learned,
                          StepTimes* times = nullptr);

}  // namespace ghtrack

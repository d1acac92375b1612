#pragma once

#include <string>
#include <vector>

#include "tools/run/offline.hpp"
#include "tracker/learning/learning.hpp"

namespace ghtrack {

/// A configuration that says all that there is to say for some recorded scans.
struct LearnedConfig {
  OfflineConfig config;
  LearnedTracker learned;
  std::vector<std::string> sensors;  // names, by index
};

/// Whether a configuration leaves anything open that has to be learned from the data.
/// @param has_sigma  whether all detections say their error
bool leaves_open(const OfflineConfig& config, const std::vector<std::string>& sensors,
                 bool has_sigma);

/// Learns what the configuration does not say from the first of the scans, as many as are enough,
/// or from all. Whether a sensor reports one object at a time is recognised from its times.
/// The result has all that is said, so that tracking with it does not depend on how it was found.
LearnedConfig learn_offline(const OfflineConfig& config, const ScanSource& scans);

/// What was learned, in lines for people: each number with its interval of 95 %.
std::vector<std::string> describe(const LearnedConfig& learned);

}  // namespace ghtrack

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracker/arrival.hpp"

namespace ghtrack {

/// What a tracker could not use in a run.
struct RunCounts {
  struct Sensor {
    std::string name;
    ArrivalCounts scans;
  };
  std::vector<Sensor> sensors;          // in the order of the scene
  std::int64_t detections_refused = 0;  // without a finite position and covariance
};

}  // namespace ghtrack

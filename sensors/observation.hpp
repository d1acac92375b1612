#pragma once

#include <vector>

#include "sensors/detection.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// The origin of a false detection.
inline constexpr ObjectId kClutterOrigin = -1;

/// A scan together with the answer sheet. The tracker gets the scan alone; the origins are for
/// scoring, and for the textbook's `association: known`.
struct Observation {
  Scan scan;
  std::vector<ObjectId>
      origins;  // origins[i] made scan.detections[i]; kClutterOrigin if nothing did
};

}  // namespace ghtrack

#pragma once

#include <vector>

#include "sensors/observation.hpp"

namespace ghtrack {

/// A detection with what made it.
struct Sighting {
  Detection detection;
  ObjectId origin = kClutterOrigin;
};

/// What a sensor of limited resolution makes of detections that lie close together: all that are
/// linked by steps shorter than `resolution` [m] become one, at their mean, with the mean of their
/// covariances. It has the origin and the label of the object's detection nearest to the mean, of
/// clutter only if there is no other.
std::vector<Sighting> merge_close(std::vector<Sighting> sightings, double resolution);

}  // namespace ghtrack

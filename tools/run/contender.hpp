#pragma once

#include <string>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/run/scene_tracker.hpp"

namespace ghtrack {

/// Who follows the scans of a run: a tracker, under a name, that has not seen anything yet. All
/// contenders of a run get the same scans.
struct Contender {
  std::string name;
  SceneTracker tracker;
};

/// The scene's own tracker.
/// @throws std::invalid_argument, as the others here, if a filter cannot be designed for the
/// scene's
///         sensors
Contender own_tracker(const WorldScene& scene);

/// The scene's tracker with one filter for every target.
Contender with_filter(const WorldScene& scene, const std::string& name, const FilterConfig& filter);

/// The filters to compare, in the scene's order; without any under `compare` the scene's own
/// tracker alone.
std::vector<Contender> compared_filters(const WorldScene& scene);

}  // namespace ghtrack

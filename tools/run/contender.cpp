#include "tools/run/contender.hpp"

#include <utility>

#include "sensors/sensor.hpp"

namespace ghtrack {

Contender own_tracker(const WorldScene& scene) {
  return {"scene", SceneTracker(scene.tracker, traits_of(scene.sensors))};
}

Contender with_filter(const WorldScene& scene, const std::string& name,
                      const FilterConfig& filter) {
  TrackerConfig config = scene.tracker;
  config.filters = {{std::string(TrackerConfig::kDefaultFilter), filter}};
  return {name, SceneTracker(std::move(config), traits_of(scene.sensors))};
}

std::vector<Contender> compared_filters(const WorldScene& scene) {
  if (scene.compare.filters.empty()) return {own_tracker(scene)};
  std::vector<Contender> contenders;
  for (const std::string& name : scene.compare.names()) {
    contenders.push_back(with_filter(scene, name, scene.compare.filters.at(name)));
  }
  return contenders;
}

}  // namespace ghtrack

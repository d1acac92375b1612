#include "tools/film/contender.hpp"

#include <fmt/format.h>

#include <utility>

#include "sensors/sensor.hpp"
#include "tools/metrics/run_metrics.hpp"

namespace ghtrack::film {

TrackerConfig with_filter(TrackerConfig tracker, const FilterConfig& filter) {
  tracker.filters = {{std::string(TrackerConfig::kDefaultFilter), filter}};
  return tracker;
}

Contender::Contender(const WorldScene& scene, const std::string& name, TrackerConfig tracker)
    : drawing_{.name = name, .gains = {}},
      tracker_(std::move(tracker), traits_of(scene.sensors)),
      score_(scoring_for(traits_of(scene.sensors)).gospa()) {
  const Filter& designed = tracker_.design().filter_for(TrackerConfig::kDefaultFilter, 0);
  drawing_.gains = fmt::format("{} {}", ghtrack::name(designed), gains_text(designed));
}

void Contender::add(const Observation& observation) {
  tracker_.step(observation);
}

void Contender::score(const TruthSnapshot& truth) { score_.add(truth, tracker_.snapshot()); }

render::PanelFrame Contender::frame() const {
  return {.tracks = tracker_.snapshot(),
          .pairings = score_.pairings(),
          .gospa = score_.gospa(),
          .rmse = score_.rmse()};
}

std::vector<Contender> contenders_of(const WorldScene& scene) {
  std::vector<Contender> contenders;
  for (const auto& [name, filter] : scene.compare.filters)
    contenders.emplace_back(scene, name, with_filter(scene.tracker, filter));
  return contenders;
}

}  // namespace ghtrack::film

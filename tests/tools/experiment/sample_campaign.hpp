#pragma once

#include <string>
#include <variant>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "tools/experiment/campaign.hpp"
#include "tools/experiment/engine.hpp"
#include "tools/experiment/results.hpp"

namespace ghtrack::testing {

/// A body at constant velocity, seen ten times a second with sigma 0.5 m.
inline WorldScene steady_scene(const std::string& compare) {
  const std::string text = R"(
name: steady
seed: 5
duration: 12
world: {gravity: 0, air: {density: 0}}
targets:
  - {name: puck, ball: {mass: 1, radius: 0.1, position: [0, 0], velocity: [8, 3]}}
sensors:
  - {name: camera, rate: 10, noise: 0.5}
tracker: {association: known}
compare: )" + compare + "\n";
  return std::get<WorldScene>(read_scene_text(text, "steady.yaml"));
}

inline Campaign campaign_of_scene(const WorldScene& scene) {
  return {{{scene, "steady.yaml", ""}}};
}

/// Computes all runs of a campaign with so many threads.
inline Results all_results(const Campaign& campaign, int jobs = 1) {
  Results results(campaign);
  compute(
      campaign, groups_by_truth(campaign), Shard{}, RunSet(campaign), jobs, [] {},
      [&](std::size_t cell, int run, const std::vector<double>& scores) {
        results.put(cell, run, scores);
      });
  return results;
}

}  // namespace ghtrack::testing

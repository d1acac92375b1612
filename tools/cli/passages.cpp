#include "tools/cli/passages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

namespace ghtrack::cli {

std::string told_of_passage(const WorldEvent& event, const std::vector<ObjectInfo>& objects) {
  const auto name = [&](ObjectId object) {
    return objects.at(static_cast<std::size_t>(object)).name;
  };
  return fmt::format(
      "'{}' and '{}' pass through each other from {:.3f} s on, at ({:.6g}, {:.6g}): trains meet "
      "only "
      "where their tracks are one and the same from end to end, and only from outside",
      name(event.object), name(event.other), event.time, event.position.x(), event.position.y());
}

namespace {

/// The key of the target that an object is, or is a copy of.
std::string key_of(const WorldScene& scene, const std::string& object) {
  std::size_t best = 0, length = 0;
  for (std::size_t i = 0; i < scene.targets.size(); ++i) {
    const std::string& name = scene.targets[i].name;
    const bool is_it = object == name || object.starts_with(name + " ");
    if (!is_it || name.size() < length) continue;
    best = i;
    length = name.size();
  }
  return fmt::format("targets[{}]", best);
}

}  // namespace

std::vector<ForeseenPassage> foreseen_passages(const WorldScene& scene) {
  constexpr double kMostSteps = 2e6;  // of single trains
  WorldConfig config{.physics = scene.physics, .environment = {}, .targets = {}};
  for (const Target& target : scene.targets) {
    if (std::holds_alternative<Train>(target.motion)) config.targets.push_back(target);
  }
  const auto trains = static_cast<double>(spell_out(config.targets).size());
  if (trains < 2.0) return {};
  const double affordable = kMostSteps / (trains * scene.duration);
  config.physics.rate = std::min(config.physics.rate, std::max(20.0, affordable));
  World world(config, scene.seed);
  world.sample(scene.duration);
  std::vector<ForeseenPassage> passages;
  for (const WorldEvent& event : world.events()) {
    if (event.kind != EventKind::kPassage) continue;
    const auto later = static_cast<std::size_t>(std::max(event.object, event.other));
    passages.push_back({.key = key_of(scene, world.objects().at(later).name),
                        .told = told_of_passage(event, world.objects())});
  }
  return passages;
}

}  // namespace ghtrack::cli

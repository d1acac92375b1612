#include "scenes/schema/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/key_path.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {
namespace {

using Filters = std::map<std::string, FilterConfig>;

constexpr double kMostFrames = 1e6;  // of a video

std::vector<std::string_view> classes_of(const std::vector<Target>& targets) {
  std::vector<std::string_view> classes;
  for (const Target& target : targets) {
    const std::string_view kind = kind_of(target.motion);
    if (std::find(classes.begin(), classes.end(), kind) == classes.end()) classes.push_back(kind);
  }
  return classes;
}

/// A filter for a class that nothing has would wait for ever, and another one serve in its place.
void find_idle_filters(const WorldScene& scene, std::vector<SceneProblem>& found) {
  std::vector<std::string_view> names = classes_of(scene.targets);
  names.push_back(TrackerConfig::kDefaultFilter);
  for (const auto& [name, filter] : scene.tracker.filters) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    found.push_back({schema::join_path("tracker.filters", name),
                     "no target of this scene is of that class" + hint(name, "names", names)});
  }
}

/// Designs each filter for the scene's sensors, as a run does.
void find_undesignable_filters(const WorldScene& scene, const std::string& path,
                               const Filters& filters, std::vector<SceneProblem>& found) {
  for (const auto& [name, filter] : filters) {
    TrackerConfig alone = scene.tracker;
    alone.association = Association::kNearestGlobal;  // filters do not depend on it
    alone.filters = {{std::string(TrackerConfig::kDefaultFilter), filter}};
    try {
      const TrackerDesign design(alone, traits_of(scene.sensors));
    } catch (const std::invalid_argument& error) {
      found.push_back({schema::join_path(path, name),
                       fmt::format("cannot be made for these sensors: {}", error.what())});
    }
  }
}

void find_endless_video(const WorldScene& scene, std::vector<SceneProblem>& found) {
  if (!scene.video) return;
  const VideoConfig& video = *scene.video;
  const double end = std::min(video.to.value_or(scene.duration), scene.duration);
  const double frames = std::round((end - video.from) * video.slow * video.fps);
  if (frames <= kMostFrames) return;
  found.push_back({"video", fmt::format("would have {} frames; at most {} are possible: shorten it "
                                        "or lower the frame rate",
                                        frames, kMostFrames)});
}

}  // namespace

std::vector<SceneProblem> find_problems(const WorldScene& scene) {
  std::vector<SceneProblem> found;
  find_idle_filters(scene, found);
  find_undesignable_filters(scene, "tracker.filters", scene.tracker.filters, found);
  find_undesignable_filters(scene, "compare.filters", scene.compare.filters, found);
  find_endless_video(scene, found);
  return found;
}

}  // namespace ghtrack

#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scenes/schema/compare_config.hpp"
#include "scenes/schema/names.hpp"
#include "scenes/schema/series.hpp"
#include "scenes/schema/video_config.hpp"
#include "sensors/sensor.hpp"
#include "sim/environment.hpp"
#include "sim/target.hpp"
#include "sim/world.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// A simulated world, the sensors that look at it, and the tracker that sees what they report.
struct WorldScene {
  static constexpr std::string_view kind = "world";
  static constexpr std::string_view about =
      "a simulated world, the sensors that look at it and the tracker that sees what they report";

  std::string name;
  std::uint64_t seed = 1;
  double duration = 20.0;  // [s]
  PhysicsConfig physics;
  EnvironmentConfig environment;
  RecordConfig record;
  std::vector<Target> targets;
  std::vector<SensorConfig> sensors;
  TrackerConfig tracker;
  std::optional<VideoConfig> video;
  CompareConfig compare;

  // Out of line: to copy all of this is much code, and every command does.
  WorldScene();
  WorldScene(const WorldScene&);
  WorldScene(WorldScene&&) noexcept;
  WorldScene& operator=(const WorldScene&);
  WorldScene& operator=(WorldScene&&) noexcept;
  ~WorldScene();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &WorldScene::name,
            {.meaning = "names the folder of the results; by default the name of the file"});
    v.field("seed", &WorldScene::seed, {.meaning = "chooses every random number of the run"});
    v.field("duration", &WorldScene::duration,
            {.unit = "s", .meaning = "length of the run", .above = 0.0, .maximum = 1e6});
    v.field("physics", &WorldScene::physics, {.meaning = "how the world is computed"});
    v.field("world", &WorldScene::environment, {.meaning = "gravity, air, wind and ground"});
    v.field("record", &WorldScene::record,
            {.meaning = "what is written of the truth beside its kinematics"});
    v.field("targets", &WorldScene::targets,
            {.meaning = "what moves", .required = true, .min_items = 1, .max_items = 10'000});
    v.field("sensors", &WorldScene::sensors,
            {.meaning = "what looks", .required = true, .min_items = 1, .max_items = 64});
    v.field("tracker", &WorldScene::tracker, {.meaning = "what turns detections into tracks"});
    v.field("video", &WorldScene::video, {.meaning = "the video; without it none is made"});
    v.field("compare", &WorldScene::compare, {.meaning = "for `ghtrack compare`"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (const auto flaw = flaw_of_name(name); !flaw.empty()) report("name", flaw);
    for (const TargetProblem& problem : find_problems(targets, environment)) {
      report("targets[" + std::to_string(problem.target) + "]", problem.message);
    }
    report_repeated_names(sensors, "sensors", report);
    const auto check_target = [&](const std::string& key, const std::string& wanted) {
      if (!has_target(wanted)) report(key, "no target is called '" + wanted + "'");
    };
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      for (std::size_t j = 0; j < sensors[i].nearest_first.size(); ++j) {
        check_target("sensors[" + std::to_string(i) + "].nearest_first[" + std::to_string(j) + "]",
                     sensors[i].nearest_first[j]);
      }
    }
    if (!video) return;
    if (video->from >= duration) report("video.from", "must be before the end of the run");
    if (video->follow) check_target("video.follow", *video->follow);
    if (video->close_up) check_target("video.close_up.target", video->close_up->target);
    for (std::size_t i = 0; i < video->shots.size(); ++i) {
      const VideoShot& shot = video->shots[i];
      if (shot.target) check_target("video.shots[" + std::to_string(i) + "].target", *shot.target);
    }
  }

  /// Is there a target of that name, once copies are spelled out and everyone is named?
  bool has_target(std::string_view target) const {
    const std::vector<Target> all = spell_out(targets);
    return std::any_of(all.begin(), all.end(),
                       [target](const Target& one) { return one.name == target; });
  }
};

/// What a scene file may hold; its key `kind` says which, a world by default.
using Scene = std::variant<WorldScene, SeriesScene>;

}  // namespace ghtrack

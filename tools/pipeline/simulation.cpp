#include "tools/pipeline/simulation.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "sensors/sensor.hpp"
#include "tools/pipeline/scene_tracker.hpp"
#include "tools/pipeline/sensing.hpp"

namespace ghtrack {
namespace {

constexpr double kExtentRate = 10.0;  // [Hz]

/// One run of a scene.
class Run {
 public:
  Run(const WorldScene& scene, World& world, const Listener& listener)
      : scene_(scene),
        world_(world),
        listener_(listener),
        tracker_(scene.tracker, traits_of(scene.sensors)) {}

  RunCounts to_the_end() {
    const Setting setting{
        .objects = world_.objects(), .classes = regime_kinds(), .seed = scene_.seed};
    const TruthSource truth = [this](double time) {
      show_frames_before(time);
      return std::make_shared<const TruthSnapshot>(world_.sample(time));
    };
    const auto on_sensed = [this](const SensedScan& scan) {
      if (listener_.on_observation) listener_.on_observation(*scan.truth, scan.observation);
    };
    sense(scene_, setting, truth, on_sensed, [this](SensedScan scan) { deliver(std::move(scan)); });
    show_frames_before(std::numeric_limits<double>::infinity());
    return counts();
  }

 private:
  void deliver(SensedScan sensed) {
    show_frames_before(sensed.arrival);
    if (tracker_.step(sensed.observation) == ScanFate::kProcessed) {
      listener_.on_scan({*sensed.truth, std::move(sensed.observation), tracker_.snapshot()});
    } else if (listener_.on_late_scan) {
      listener_.on_late_scan(sensed.observation);
    }
  }

  void show_frames_before(double time) {
    const std::vector<double>& times = listener_.frame_times;
    for (; frame_ < times.size() && times[frame_] < time; ++frame_) {
      listener_.on_frame(world_.sample(times[frame_]));
    }
  }

  RunCounts counts() const {
    RunCounts counts;
    counts.detections_refused = tracker_.detections_refused();
    for (std::size_t i = 0; i < scene_.sensors.size(); ++i) {
      counts.sensors.push_back({scene_.sensors[i].name, {}});
      if (i < tracker_.arrivals().size()) counts.sensors.back().scans = tracker_.arrivals()[i];
    }
    return counts;
  }

  const WorldScene& scene_;
  World& world_;
  const Listener& listener_;
  SceneTracker tracker_;
  std::size_t frame_ = 0;  // the next one
};

}  // namespace

World make_world(const WorldScene& scene) {
  return World({scene.physics, scene.environment, scene.targets}, scene.seed);
}

RunCounts run(const WorldScene& scene, World& world, const Listener& listener) {
  return Run(scene, world, listener).to_the_end();
}

std::vector<Vec2> places_visited(const WorldScene& scene, const std::function<void()>& on_sample) {
  World world = make_world(scene);
  std::vector<Vec2> places;
  const auto samples = static_cast<std::int64_t>(std::floor(scene.duration * kExtentRate));
  for (std::int64_t i = 0; i <= samples; ++i) {
    on_sample();
    for (const BodyPose& body : world.sample(static_cast<double>(i) / kExtentRate).bodies) {
      places.push_back(body.position);
    }
  }
  return places;
}

}  // namespace ghtrack

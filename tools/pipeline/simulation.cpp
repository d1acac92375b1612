#include "tools/pipeline/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "sensors/sensor.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {
namespace {

constexpr double kExtentRate = 10.0;  // [Hz]

/// The scans of all sensors of a scene in the order of time, sensors of the same instant in the
/// order of the scene.
class ScanSchedule {
 public:
  explicit ScanSchedule(const WorldScene& scene)
      : scene_(scene), next_scan_(scene.sensors.size(), 0) {}

  struct Entry {
    double time;
    int sensor;
    std::int64_t scan;
  };

  std::optional<Entry> next() {
    std::optional<Entry> first;
    for (std::size_t i = 0; i < next_scan_.size(); ++i) {
      const double time = scan_time(scene_.sensors[i], next_scan_[i]);
      if (time <= scene_.duration && (!first || time < first->time)) {
        first = {time, static_cast<int>(i), next_scan_[i]};
      }
    }
    if (first) ++next_scan_[static_cast<std::size_t>(first->sensor)];
    return first;
  }

 private:
  const WorldScene& scene_;
  std::vector<std::int64_t> next_scan_;  // of each sensor
};

std::vector<SensorTraits> traits_of(const std::vector<SensorConfig>& sensors) {
  std::vector<SensorTraits> traits;
  for (const SensorConfig& sensor : sensors) traits.push_back(traits_of(sensor));
  return traits;
}

}  // namespace

World make_world(const WorldScene& scene) {
  return World({scene.physics, scene.environment, scene.targets}, scene.seed);
}

void run(const WorldScene& scene, World& world, const Listener& listener) {
  const TrackerDesign design(scene.tracker, traits_of(scene.sensors));
  const Setting setting{.objects = world.objects(), .classes = regime_kinds(), .seed = scene.seed};
  TrackerState tracker;
  std::size_t frame = 0;
  const auto show_frames_before = [&](double time) {
    for (; frame < listener.frame_times.size() && listener.frame_times[frame] < time; ++frame) {
      listener.on_frame(world.sample(listener.frame_times[frame]));
    }
  };
  ScanSchedule schedule(scene);
  while (const auto next = schedule.next()) {
    show_frames_before(next->time);
    StepRecord record;
    record.truth = world.sample(next->time);
    record.observation = observe(scene.sensors[static_cast<std::size_t>(next->sensor)],
                                 next->sensor, next->scan, record.truth, setting);
    tracker = step(design, std::move(tracker), record.observation.scan, record.observation.origins);
    record.tracks = snapshot(tracker);
    listener.on_scan(record);
  }
  show_frames_before(std::numeric_limits<double>::infinity());
}

std::vector<Vec2> places_visited(const WorldScene& scene) {
  World world = make_world(scene);
  std::vector<Vec2> places;
  const auto samples = static_cast<std::int64_t>(std::floor(scene.duration * kExtentRate));
  for (std::int64_t i = 0; i <= samples; ++i) {
    for (const BodyPose& body : world.sample(static_cast<double>(i) / kExtentRate).bodies) {
      places.push_back(body.position);
    }
  }
  return places;
}

}  // namespace ghtrack

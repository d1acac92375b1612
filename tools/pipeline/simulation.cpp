#include "tools/pipeline/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "sensors/sensor.hpp"
#include "tracker/replay.hpp"

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

  /// The next scan, until take() is called.
  std::optional<Entry> next() const {
    std::optional<Entry> first;
    for (std::size_t i = 0; i < next_scan_.size(); ++i) {
      const double time = scan_time(scene_.sensors[i], next_scan_[i]);
      if (time <= scene_.duration && (!first || time < first->time)) {
        first = {time, static_cast<int>(i), next_scan_[i]};
      }
    }
    return first;
  }
  void take(const Entry& entry) { ++next_scan_[static_cast<std::size_t>(entry.sensor)]; }

 private:
  const WorldScene& scene_;
  std::vector<std::int64_t> next_scan_;  // of each sensor
};

/// One run of a scene.
class Run {
 public:
  Run(const WorldScene& scene, World& world, const Listener& listener)
      : scene_(scene),
        world_(world),
        listener_(listener),
        setting_{.objects = world.objects(), .classes = regime_kinds(), .seed = scene.seed},
        design_(scene.tracker, traits_of(scene.sensors)),
        schedule_(scene) {}

  RunCounts to_the_end() {
    for (auto scan = schedule_.next(); scan || !under_way_.empty(); scan = schedule_.next()) {
      if (scan && (under_way_.empty() || scan->time <= under_way_.begin()->first.arrival)) {
        schedule_.take(*scan);
        sense(*scan);
      } else {
        deliver(under_way_.extract(under_way_.begin()).mapped());
      }
    }
    show_frames_before(std::numeric_limits<double>::infinity());
    return counts();
  }

 private:
  struct Sensed {
    TruthSnapshot truth;
    Observation observation;
    double arrival = 0.0;  // [s]
  };

  /// The order in which scans reach the tracker.
  struct ArrivalKey {
    double arrival = 0.0;
    double time = 0.0;
    int sensor = 0;
    auto operator<=>(const ArrivalKey&) const = default;
  };

  void sense(const ScanSchedule::Entry& scan) {
    show_frames_before(scan.time);
    const SensorConfig& sensor = scene_.sensors[static_cast<std::size_t>(scan.sensor)];
    Sensed sensed;
    sensed.truth = world_.sample(scan.time);
    sensed.observation = observe(sensor, scan.sensor, scan.scan, sensed.truth, setting_);
    sensed.arrival = scan.time + sensor.latency;
    if (listener_.on_observation) listener_.on_observation(sensed.truth, sensed.observation);
    under_way_.emplace(ArrivalKey{sensed.arrival, scan.time, scan.sensor}, std::move(sensed));
  }

  void deliver(Sensed sensed) {
    show_frames_before(sensed.arrival);
    const Scan& scan = sensed.observation.scan;
    tracker_ = step(design_, std::move(tracker_), scan, sensed.observation.origins);
    const bool is_latest = tracker_.now.time == scan.time && tracker_.now.sensor == scan.sensor;
    if (is_latest) {
      listener_.on_scan(
          {std::move(sensed.truth), std::move(sensed.observation), snapshot(tracker_.now)});
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
    counts.detections_refused = tracker_.now.detections_refused;
    for (std::size_t i = 0; i < scene_.sensors.size(); ++i) {
      counts.sensors.push_back({scene_.sensors[i].name, {}});
      if (i < tracker_.arrivals.size()) counts.sensors.back().scans = tracker_.arrivals[i];
    }
    return counts;
  }

  const WorldScene& scene_;
  World& world_;
  const Listener& listener_;
  Setting setting_;
  TrackerDesign design_;
  ScanSchedule schedule_;
  std::map<ArrivalKey, Sensed> under_way_;  // sensed, but not arrived yet
  ReplayState tracker_;
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

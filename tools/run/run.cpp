#include "tools/run/run.hpp"

#include <algorithm>
#include <compare>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "sensors/sensor.hpp"
#include "tools/run/schedule.hpp"

namespace ghtrack {
namespace {

/// The order in which scans reach the trackers.
struct ArrivalKey {
  double arrival = 0.0;  // scan time + latency [s]
  double time = 0.0;
  int sensor = 0;
  auto operator<=>(const ArrivalKey&) const = default;
};

/// A scan on its way from the sensor, with the truth of its instant.
struct SensedScan {
  std::shared_ptr<const TruthSnapshot> truth;
  Observation observation;
};

class Run {
 public:
  Run(const WorldScene& scene, TruthSource& truth, std::span<const Contender> contenders,
      const RunObservers& observers, std::span<const double> frame_times)
      : scene_(scene),
        truth_(truth),
        setting_{.objects = truth.objects(),
                 .classes = detectable_classes(truth.objects()),
                 .seed = scene.seed},
        observers_(observers),
        frame_times_(frame_times) {
    for (const Contender& contender : contenders) trackers_.push_back(contender.tracker);
    has_latency_ = std::any_of(scene.sensors.begin(), scene.sensors.end(),
                               [](const SensorConfig& sensor) { return sensor.latency > 0.0; });
  }

  void to_the_end() {
    ScanSchedule schedule(scene_);
    for (auto scan = schedule.next(); scan || !under_way_.empty(); scan = schedule.next()) {
      if (!scan || (!under_way_.empty() && under_way_.begin()->first.arrival < scan->time)) {
        auto arrived = under_way_.extract(under_way_.begin());
        tell_what_was_known_before(arrived.key().arrival);
        show_frames_before(arrived.key().arrival);
        track(std::move(arrived.mapped()));
      } else {
        schedule.take(*scan);
        tell_what_was_known_before(scan->time);
        show_frames_before(scan->time);
        sense(*scan);
      }
    }
    tell_what_was_known_before(std::numeric_limits<double>::infinity());
    show_frames_before(std::numeric_limits<double>::infinity());
  }

  std::vector<RunCounts> counts() const {
    std::vector<RunCounts> all;
    for (const SceneTracker& tracker : trackers_) {
      RunCounts& counts = all.emplace_back();
      counts.detections_refused = tracker.detections_refused();
      for (std::size_t i = 0; i < scene_.sensors.size(); ++i) {
        counts.sensors.push_back({scene_.sensors[i].name, {}});
        if (i < tracker.arrivals().size()) counts.sensors.back().scans = tracker.arrivals()[i];
      }
    }
    return all;
  }

 private:
  void sense(const ScanSchedule::Entry& entry) {
    const SensorConfig& sensor = scene_.sensors[static_cast<std::size_t>(entry.sensor)];
    SensedScan scan{truth_.at(entry.time), {}};
    scan.observation = observe(sensor, entry.sensor, entry.scan, *scan.truth, setting_);
    for (RunObserver* observer : observers_) {
      observer->add_observation(*scan.truth, scan.observation);
    }
    if (trackers_.empty()) return;
    if (has_latency_) latest_ = scan.truth;
    under_way_.emplace(ArrivalKey{entry.time + sensor.latency, entry.time, entry.sensor},
                       std::move(scan));
  }

  void track(SensedScan scan) {
    StepRecord record{
        .truth = *scan.truth, .observation = std::move(scan.observation), .tracks = {}};
    for (std::size_t i = 0; i < trackers_.size(); ++i) {
      record.contender = i;
      record.fate = trackers_[i].step(record.observation);
      record.tracks = trackers_[i].snapshot();
      for (RunObserver* observer : observers_) observer->add_tracks(record);
    }
  }

  /// Of the instant of the latest scan: all that came at that time has arrived.
  void tell_what_was_known_before(double time) {
    if (!latest_ || !(latest_->time < time)) return;
    for (std::size_t i = 0; i < trackers_.size(); ++i) {
      const TrackSnapshot known = trackers_[i].predicted(latest_->time);
      for (RunObserver* observer : observers_) observer->add_known(*latest_, known, i);
    }
    latest_.reset();
  }

  void show_frames_before(double time) {
    for (; !frame_times_.empty() && frame_times_.front() < time;
         frame_times_ = frame_times_.subspan(1)) {
      const std::shared_ptr<const TruthSnapshot> truth = truth_.at(frame_times_.front());
      for (RunObserver* observer : observers_) observer->add_frame(*truth);
    }
  }

  const WorldScene& scene_;
  TruthSource& truth_;
  Setting setting_;
  const RunObservers& observers_;
  std::span<const double> frame_times_;  // that are still to come
  std::vector<SceneTracker> trackers_;   // of the contenders
  bool has_latency_ = false;
  std::shared_ptr<const TruthSnapshot> latest_;  // of which it is yet to be told what was known
  std::map<ArrivalKey, SensedScan> under_way_;
};

}  // namespace

std::vector<RunCounts> run(const WorldScene& scene, TruthSource& truth,
                           std::span<const Contender> contenders, const RunObservers& observers,
                           std::span<const double> frame_times) {
  Run run(scene, truth, contenders, observers, frame_times);
  run.to_the_end();
  return run.counts();
}

}  // namespace ghtrack

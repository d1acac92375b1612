#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sensors/sensor.hpp"
#include "tools/experiment/labelled_objects.hpp"
#include "tracker/filters/gains/gains.hpp"

namespace ghtrack {

/// What errors of position may be held against, on the same runs: RMSE over the scans from an object's
/// third detection on [m]. Absent where there is nothing to tell it from.
struct Hindsight {
  std::optional<double> raw;  // of the detections themselves

  /// Of the best filter with fixed gains, chosen afterwards: the least expected error, over all
  /// measurement noise, of any g, g-h or g-h-k filter, whether it starts with growing memory or as
  /// Kalman's. It knows which detection is whose.
  std::optional<double> best_fixed_gains;
  Gains best;  // its gains in the steady state

  /// Of a smoother (Rauch, Tung & Striebel 1965) that has all detections of the run, the later ones
  /// included, and the best process noise, chosen afterwards: a filter cannot know as much.
  std::optional<double> smoother;
};

/// The objects of one kind in all runs that are judged.
using ObjectsOfRuns = std::vector<const LabelledObject*>;

/// @param sensors  by ObjectScan::sensor
/// @param on_step  called again and again; may throw to give up
Hindsight in_hindsight(const ObjectsOfRuns& objects, std::span<const SensorConfig> sensors,
                       const RunMetricsOptions& scoring, const std::function<void()>& on_step);

/// Those to be recorded for add_hindsight(): all objects of a scene, or none where they would be
/// looked at more often than 20 000 times, so that the memory of a run does not grow with its length.
std::vector<ObjectId> objects_for_hindsight(const WorldScene& scene, std::size_t objects);

/// Writes into the report of a run what each object's error may be held against.
/// @param objects  of the run
void add_hindsight(RunReport& report, const std::vector<LabelledObject>& objects,
                   std::span<const SensorConfig> sensors, const std::function<void()>& on_step);

}  // namespace ghtrack

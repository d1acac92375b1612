#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sensors/sensor.hpp"
#include "tools/experiment/labelled_objects.hpp"
#include "tools/experiment/posterior_bound.hpp"
#include "tracker/filters/gains/gains.hpp"

namespace ghtrack {

/// What errors of position may be held against, on the same runs: RMSE over the scans from an
/// object's third detection on [m]. Absent where there is nothing to tell it from.
struct Hindsight {
  std::optional<double> raw;  // of the detections themselves

  /// Of the best filter with fixed gains, chosen afterwards: the least expected error, over all
  /// measurement noise, of any g, g-h or g-h-k filter, whether it starts with growing memory or as
  /// Kalman's. It knows which detection is whose.
  std::optional<double> best_fixed_gains;
  Gains best;  // its gains in the steady state

  /// That no filter can beat over all motions and all noise, where the motion is random by a law
  /// that is known: see posterior_bound().
  std::optional<double> crlb;

  /// Of a smoother (Rauch, Tung & Striebel 1965) that has all detections of the run, the later ones
  /// included, and the best process noise, chosen afterwards: a filter cannot know as much.
  std::optional<double> smoother;
};

/// One of the figures above, as tables and files have it.
struct Reference {
  std::string_view name;   // of a column or key: "best_fixed_gains"
  std::string_view title;  // at the head of a table: "best fixed"
  std::optional<double> Hindsight::*value;
};
inline constexpr std::array<Reference, 4> kReferences = {
    {{"raw", "raw", &Hindsight::raw},
     {"best_fixed_gains", "best fixed", &Hindsight::best_fixed_gains},
     {"crlb", "CRLB", &Hindsight::crlb},
     {"smoother", "smoother", &Hindsight::smoother}}};

/// The objects of one kind in all runs that are judged.
using ObjectsOfRuns = std::vector<const LabelledObject*>;

/// The sensor that filters are designed for, as in TrackerDesign: the one that tells most in a
/// given time. @pre there is one
SensorTraits best_sensor(std::span<const SensorConfig> sensors);

/// The gains of an order, 0 to 2, with the least expected error.
/// @param sensors  by ObjectScan::sensor
/// @param on_step  called again and again; may throw to give up
/// @return nothing if the sensors' errors have no variance
std::optional<Gains> best_gains(const ObjectsOfRuns& objects, std::span<const SensorConfig> sensors,
                                const RunMetricsOptions& scoring, int order,
                                const std::function<void()>& on_step);

/// @param sensors  by ObjectScan::sensor
/// @param motions  by object, as far as they are random
/// @param on_step  called again and again; may throw to give up
Hindsight in_hindsight(const ObjectsOfRuns& objects, std::span<const SensorConfig> sensors,
                       std::span<const std::optional<RandomMotion>> motions,
                       const RunMetricsOptions& scoring, const std::function<void()>& on_step);

/// Those to be recorded for add_hindsight(): all objects of a scene, or none where they would be
/// looked at more often than 20 000 times, so that the memory of a run does not grow with its
/// length.
std::vector<ObjectId> objects_for_hindsight(const WorldScene& scene, std::size_t objects);

/// Writes into the report of a run what each object's error may be held against.
/// @param objects  of the run
void add_hindsight(RunReport& report, const std::vector<LabelledObject>& objects,
                   const WorldScene& scene, const std::function<void()>& on_step);

}  // namespace ghtrack

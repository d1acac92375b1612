#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sensors/detection.hpp"
#include "sim/truth.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/metrics/expected_measurement.hpp"
#include "tools/metrics/mean.hpp"
#include "tracker/filters/filter.hpp"

// Filters that are told which detection is whose, one object at a time: what is left of a tracking
// problem when association is taken away. Gains are searched for and bounds are found here.

namespace ghtrack {

/// One scan as far as it concerns one object.
struct ObjectScan {
  double time = 0.0;  // [s]
  TruthState truth;
  std::optional<Detection> detection;  // made by the object
  int sensor = 0;                      // that looked
};

/// An object from its first detection to its end.
struct LabelledObject {
  ObjectId id = 0;
  std::vector<ObjectScan> scans;
};

/// The objects of each of some runs.
using LabelledRuns = std::vector<std::vector<LabelledObject>>;

/// The first objects of each regime, at least one: as many as make about so many scans of an object
/// in a run. What is searched for or averaged over again and again need not see the whole of a
/// large swarm.
std::vector<ObjectId> some_objects(const Trial& trial, std::size_t scans);

/// Takes down what each scan says of some objects.
class LabelledObjectRecorder final : public RunObserver {
 public:
  LabelledObjectRecorder(std::size_t objects, const std::vector<ObjectId>& wanted);

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override;

  /// Those that have been detected at all.
  std::vector<LabelledObject> objects() &&;

 private:
  std::vector<std::optional<std::size_t>> place_;  // of each object in `objects_`
  std::vector<LabelledObject> objects_;
};

/// Those of these objects that are detected at all in a run, by id.
std::vector<LabelledObject> labelled_objects(const Trial& trial, int run, const RunTruth& truth,
                                             const std::vector<ObjectId>& wanted);

/// Errors count from so many detections on: some filters have no acceleration before.
inline constexpr int kFirstDetections = 3;

/// Goes through the scans of an object and, after each one whose errors count, visits it.
/// @param advance  predicts and updates: takes the scan and the time since the one before [s]
/// @param visit    takes the scan
template <class Advance, class Visit>
void visit_judged(const LabelledObject& object, const Advance& advance, const Visit& visit) {
  int detections = 0;
  double before = object.scans.empty() ? 0.0 : object.scans.front().time;
  for (const ObjectScan& scan : object.scans) {
    advance(scan, scan.time - before);
    before = scan.time;
    if (scan.detection) ++detections;
    if (detections >= kFirstDetections) visit(scan);
  }
}

/// Mean squared errors over the scans from the third detection on.
struct SquaredErrors {
  Mean position;  // [m²]
  Mean velocity;  // [m²/s²]

  SquaredErrors& operator+=(const SquaredErrors& other);
};

/// The errors that a filter makes with the detections as they are.
/// @param filter  has not started yet
SquaredErrors measured_errors(Filter filter, const LabelledObject& object);

/// The errors to be expected of a filter over all measurement noise, given which scans detected the
/// object: the squared lag of the filter on noiseless detections, and the variance of the noise
/// that it carries along, both exact for errors of the covariance that detections tell.
/// @param filter  has not started yet
SquaredErrors expected_errors(GainFilter<2> filter, const LabelledObject& object);

/// The same for sensors of any kind, with their bias and outliers; nothing is added where errors
/// have no variance. @param errors  of the sensors, by ObjectScan::sensor
SquaredErrors expected_errors(const Filter& filter, const LabelledObject& object,
                              std::span<const SensorConfig> sensors,
                              std::span<const std::vector<ErrorPart>> errors);

/// Errors of a smoother (see smoothed()), which knows all of the object's detections at every scan.
SquaredErrors smoothed_errors(const SingleFilterConfig& config, const RunMetricsOptions& scoring,
                              const LabelledObject& object);

/// A filter with given gains, and least squares at the start.
GainFilter<2> plain_filter(const Gains& gains, double sigma, double period);

}  // namespace ghtrack

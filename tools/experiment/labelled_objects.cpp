#include "tools/experiment/labelled_objects.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "tools/metrics/expected_error.hpp"
#include "tracker/filters/smoother.hpp"

namespace ghtrack {
LabelledObjectRecorder::LabelledObjectRecorder(std::size_t objects,
                                               const std::vector<ObjectId>& wanted)
    : place_(objects) {
  for (const ObjectId id : wanted) {
    place_[static_cast<std::size_t>(id)] = objects_.size();
    objects_.push_back({id, {}});
  }
}

void LabelledObjectRecorder::add_observation(const TruthSnapshot& truth,
                                             const Observation& observation) {
  if (objects_.empty()) return;
  std::vector<std::optional<Detection>> made(place_.size());
  for (std::size_t i = 0; i < observation.origins.size(); ++i) {
    const ObjectId origin = observation.origins[i];
    if (origin == kClutterOrigin || !place_[static_cast<std::size_t>(origin)]) continue;
    made[static_cast<std::size_t>(origin)] = observation.scan.detections[i];
  }
  for (const TruthState& state : truth.objects) {
    const auto id = static_cast<std::size_t>(state.id);
    if (!place_[id]) continue;
    std::vector<ObjectScan>& scans = objects_[*place_[id]].scans;
    if (scans.empty() && !made[id]) continue;
    scans.push_back({truth.time, state, made[id], observation.scan.sensor});
  }
}

std::vector<LabelledObject> LabelledObjectRecorder::objects() && {
  std::erase_if(objects_, [](const LabelledObject& object) { return object.scans.empty(); });
  return std::move(objects_);
}

std::vector<ObjectId> some_objects(const Trial& trial, std::size_t scans) {
  double each = 1.0;  // scans of one object
  for (const SensorConfig& sensor : trial.scene().sensors) {
    each += trial.scene().duration * sensor.rate;
  }
  const double share =
      static_cast<double>(scans) / (each * static_cast<double>(trial.regimes().size()));
  const auto most = std::max<std::size_t>(1, static_cast<std::size_t>(share));
  std::map<std::string_view, std::size_t> taken;  // of each regime
  std::vector<ObjectId> objects;
  for (const ObjectInfo& object : trial.objects()) {
    if (taken[object.regime]++ < most) objects.push_back(object.id);
  }
  return objects;
}

std::vector<LabelledObject> labelled_objects(const Trial& trial, int run, const RunTruth& truth,
                                             const std::vector<ObjectId>& wanted) {
  LabelledObjectRecorder recorder(trial.objects().size(), wanted);
  trial.listen(run, *truth.source(), {}, {&recorder});
  return std::move(recorder).objects();
}

SquaredErrors& SquaredErrors::operator+=(const SquaredErrors& other) {
  position += other.position;
  velocity += other.velocity;
  return *this;
}

SquaredErrors measured_errors(Filter filter, const LabelledObject& object) {
  SquaredErrors sum;
  const auto advance = [&](const ObjectScan& scan, double dt) {
    if (dt > 0.0) predict(filter, dt);
    if (!scan.detection) {
      coast(filter);
    } else if (is_started(filter)) {
      update(filter, *scan.detection);
    } else {
      start(filter, scan.detection->position, scan.detection->covariance);
    }
  };
  visit_judged(object, advance, [&](const ObjectScan& scan) {
    const Kinematics<2>& state = estimate(filter);
    sum.position.add((state.position - scan.truth.position).squaredNorm());
    sum.velocity.add((state.velocity - scan.truth.velocity).squaredNorm());
  });
  return sum;
}

SquaredErrors expected_errors(GainFilter<2> filter, const LabelledObject& object) {
  SquaredErrors sum;
  const auto advance = [&](const ObjectScan& scan, double dt) {
    if (dt > 0.0) filter.predict(dt);
    if (!scan.detection) {
      filter.coast();
    } else if (filter.is_started()) {
      filter.update(scan.truth.position, scan.detection->covariance);
    } else {
      filter.start(scan.truth.position, scan.detection->covariance);
    }
  };
  visit_judged(object, advance, [&](const ObjectScan& scan) {
    sum.position.add((filter.estimate().position - scan.truth.position).squaredNorm() +
                     filter.noise_sigma().squaredNorm());
    sum.velocity.add((filter.estimate().velocity - scan.truth.velocity).squaredNorm() +
                     filter.noise_velocity_sigma().squaredNorm());
  });
  return sum;
}

SquaredErrors expected_errors(const Filter& filter, const LabelledObject& object,
                              std::span<const SensorConfig> sensors,
                              std::span<const std::vector<ErrorPart>> errors) {
  SquaredErrors sum;
  std::optional<ExpectedError> error;
  const auto advance = [&](const ObjectScan& scan, double /*dt*/) {
    std::optional<SensedDetection> used;
    if (scan.detection) {
      const auto sensor = static_cast<std::size_t>(scan.sensor);
      used.emplace(SensedDetection{sensors[sensor], errors[sensor], *scan.detection});
    }
    if (error) {
      error->advance(scan.truth, scan.time, used);
    } else if (used) {
      error.emplace(filter, scan.truth, *used, scan.time, 0, ExpectedError::Noise::kNormal);
    }
  };
  visit_judged(object, advance, [&](const ObjectScan& scan) {
    if (!error->is_known()) return;
    const ExpectedError::Value value = error->value(scan.truth);
    sum.position.add(value.position_square());
    sum.velocity.add(value.velocity_square());
  });
  return sum;
}

SquaredErrors smoothed_errors(const SingleFilterConfig& config, const RunMetricsOptions& scoring,
                              const LabelledObject& object) {
  std::vector<TimedPosition> track;
  for (const ObjectScan& scan : object.scans) {
    TimedPosition& moment = track.emplace_back(TimedPosition{.time = scan.time, .position = {}});
    if (!scan.detection) continue;
    moment.position = scan.detection->position;
    moment.covariance = scan.detection->covariance;
  }
  const std::vector<Smoothed> states = smoothed(config, scoring.sigma, scoring.period, track);
  SquaredErrors sum;
  std::size_t i = 0;
  visit_judged(
      object, [&](const ObjectScan&, double) { ++i; },
      [&](const ObjectScan& scan) {
        const Kinematics<2>& state = states[i - 1].state;
        sum.position.add((state.position - scan.truth.position).squaredNorm());
        sum.velocity.add((state.velocity - scan.truth.velocity).squaredNorm());
      });
  return sum;
}

GainFilter<2> plain_filter(const Gains& gains, double sigma, double period) {
  GainSchedule schedule;
  schedule.steady = gains;
  schedule.interval = period;
  ErrorModel errors;
  errors.sigma = sigma;
  return {schedule, errors};
}

}  // namespace ghtrack

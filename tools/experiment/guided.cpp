#include "tools/experiment/guided.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

namespace ghtrack {
namespace {

constexpr int kFirstDetections =
    3;  // after which errors count: some filters have no acceleration yet

/// Walks through the sightings and tells `visit` after each one that counts.
/// @param advance  predicts and updates
template <class Advance, class Visit>
void walk(const SightedObject& object, const Advance& advance, const Visit& visit) {
  int detections = 0;
  double before = object.sightings.empty() ? 0.0 : object.sightings.front().time;
  for (const ObjectScan& sighting : object.sightings) {
    advance(sighting, sighting.time - before);
    before = sighting.time;
    if (sighting.detection) ++detections;
    if (detections >= kFirstDetections) visit(sighting);
  }
}

double root_mean(double sum, std::int64_t count) {
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

std::vector<ObjectId> some_objects(const Trial& trial, std::size_t sightings) {
  double scans = 1.0;  // of one object
  for (const SensorConfig& sensor : trial.scene().sensors) {
    scans += trial.scene().duration * sensor.rate;
  }
  const double share =
      static_cast<double>(sightings) / (scans * static_cast<double>(trial.regimes().size()));
  const auto most = std::max<std::size_t>(1, static_cast<std::size_t>(share));
  std::map<std::string_view, std::size_t> taken;  // of each regime
  std::vector<ObjectId> objects;
  for (const ObjectInfo& object : trial.objects()) {
    if (taken[object.regime]++ < most) objects.push_back(object.id);
  }
  return objects;
}

std::vector<SightedObject> sightings_of(const Trial& trial, int run,
                                        const std::vector<ObjectId>& wanted) {
  std::vector<SightedObject> objects;
  std::vector<std::optional<std::size_t>> place(trial.objects().size());  // in `objects`
  for (const ObjectId id : wanted) {
    place[static_cast<std::size_t>(id)] = objects.size();
    objects.push_back({id, {}});
  }
  const WorldScene scene = scene_of_run(trial.scene(), run);
  const Setting setting{.objects = trial.objects(), .classes = regime_kinds(), .seed = scene.seed};
  const auto on_sensed = [&](const SensedScan& scan) {
    std::vector<std::optional<Detection>> made(place.size());
    for (std::size_t i = 0; i < scan.observation.origins.size(); ++i) {
      const ObjectId origin = scan.observation.origins[i];
      if (origin == kClutterOrigin || !place[static_cast<std::size_t>(origin)]) continue;
      made[static_cast<std::size_t>(origin)] = scan.observation.scan.detections[i];
    }
    for (const TruthState& truth : scan.truth->objects) {
      const auto id = static_cast<std::size_t>(truth.id);
      if (!place[id]) continue;
      std::vector<ObjectScan>& sightings = objects[*place[id]].sightings;
      if (sightings.empty() && !made[id]) continue;
      sightings.push_back({scan.truth->time, truth, made[id]});
    }
  };
  sense(scene, setting, trial.truth_of(run), on_sensed, [](const SensedScan&) {});
  std::erase_if(objects, [](const SightedObject& object) { return object.sightings.empty(); });
  return objects;
}

ErrorSum& ErrorSum::operator+=(const ErrorSum& other) {
  position += other.position;
  velocity += other.velocity;
  scans += other.scans;
  return *this;
}
double ErrorSum::rmse_position() const { return root_mean(position, scans); }
double ErrorSum::rmse_velocity() const { return root_mean(velocity, scans); }

ErrorSum measured_errors(Filter filter, const SightedObject& object) {
  ErrorSum sum;
  const auto advance = [&](const ObjectScan& sighting, double dt) {
    if (dt > 0.0) predict(filter, dt);
    if (!sighting.detection) {
      coast(filter);
    } else if (is_started(filter)) {
      update(filter, sighting.detection->position, sighting.detection->covariance);
    } else {
      start(filter, sighting.detection->position, sighting.detection->covariance);
    }
  };
  walk(object, advance, [&](const ObjectScan& sighting) {
    const Kinematics<2>& state = estimate(filter);
    sum.position += (state.position - sighting.truth.position).squaredNorm();
    sum.velocity += (state.velocity - sighting.truth.velocity).squaredNorm();
    ++sum.scans;
  });
  return sum;
}

ErrorSum expected_errors(GainFilter<2> filter, const SightedObject& object) {
  ErrorSum sum;
  const auto advance = [&](const ObjectScan& sighting, double dt) {
    if (dt > 0.0) filter.predict(dt);
    if (!sighting.detection) {
      filter.coast();
    } else if (filter.is_started()) {
      filter.update(sighting.truth.position, sighting.detection->covariance);
    } else {
      filter.start(sighting.truth.position, sighting.detection->covariance);
    }
  };
  walk(object, advance, [&](const ObjectScan& sighting) {
    sum.position += (filter.estimate().position - sighting.truth.position).squaredNorm() +
                    filter.noise_sigma().squaredNorm();
    sum.velocity += (filter.estimate().velocity - sighting.truth.velocity).squaredNorm() +
                    filter.noise_velocity_sigma().squaredNorm();
    ++sum.scans;
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

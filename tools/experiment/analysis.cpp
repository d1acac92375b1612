#include "tools/experiment/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "tools/experiment/guided.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

constexpr int kTheoryRuns = 8;         // over which theory averages what differs between runs
constexpr std::size_t kIndices = 19;   // tracking indices 10^-3.5, … 10^2.5
constexpr std::size_t kGridSide = 20;  // of a gain surface
constexpr std::size_t kTheorySightings = 100'000;  // of each run
constexpr std::size_t kSurfaceSightings = 4000;

bool belongs_to(ObjectId id, const Subject& subject) {
  return std::binary_search(subject.objects.begin(), subject.objects.end(), id);
}

/// The filter with Kalata's gains in the steady state, and Kalman's on the way there, at uneven
/// times and for detections of different quality.
template <int Order>
GainFilter<2> kalman_like(double index, const RunMetricsOptions& sensor) {
  constexpr double kDiffuse = 100.0;  // the start's uncertainty, in sigmas per period
  GainFilterConfig<Order> config;
  config.design = gain_design::TrackingIndex<Order>{.index = index};
  config.schedule = GainSource::kCovariance;
  config.initial_speed = kDiffuse * sensor.sigma / sensor.period;
  config.initial_acceleration = config.initial_speed / sensor.period;
  return std::get<GainFilter<2>>(make_filter(config, sensor.sigma, sensor.period));
}

/// The filters of which the best one is the bound.
std::vector<GainFilter<2>> candidates(const RunMetricsOptions& sensor) {
  std::vector<GainFilter<2>> filters;
  for (std::size_t i = 0; i < kIndices; ++i) {
    const double index = std::pow(10.0, -3.5 + static_cast<double>(i) / 3.0);
    filters.push_back(kalman_like<1>(index, sensor));
    filters.push_back(kalman_like<2>(index, sensor));
  }
  return filters;
}

/// Sums over the truth of some objects.
struct TheorySum {
  std::vector<ErrorSum> candidates;
  double square_acceleration = 0.0;
  double square_jerk = 0.0;
  std::int64_t scans = 0;
  std::int64_t steps = 0;

  void add(const SightedObject& object, const std::vector<GainFilter<2>>& filters) {
    candidates.resize(filters.size());
    for (std::size_t i = 0; i < filters.size(); ++i) {
      candidates[i] += expected_errors(filters[i], object);
    }
    const TruthState* before = nullptr;
    double before_time = 0.0;
    for (const ObjectScan& sighting : object.sightings) {
      square_acceleration += sighting.truth.acceleration.squaredNorm();
      ++scans;
      if (before != nullptr && sighting.time > before_time) {
        const Vec2 change = sighting.truth.acceleration - before->acceleration;
        square_jerk += (change / (sighting.time - before_time)).squaredNorm();
        ++steps;
      }
      before = &sighting.truth;
      before_time = sighting.time;
    }
  }

  TheorySum& operator+=(const TheorySum& other) {
    candidates.resize(other.candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i] += other.candidates[i];
    square_acceleration += other.square_acceleration;
    square_jerk += other.square_jerk;
    scans += other.scans;
    steps += other.steps;
    return *this;
  }

  SubjectTheory theory() const {
    SubjectTheory theory;
    if (scans > 0) theory.square_acceleration = square_acceleration / static_cast<double>(scans);
    if (steps > 0) theory.square_jerk = square_jerk / static_cast<double>(steps);
    for (const ErrorSum& candidate : candidates) {
      if (candidate.scans == 0) continue;
      const double position = candidate.rmse_position();
      const double velocity = candidate.rmse_velocity();
      theory.bound_position = std::min(position, theory.bound_position.value_or(position));
      theory.bound_velocity = std::min(velocity, theory.bound_velocity.value_or(velocity));
    }
    return theory;
  }
};

/// Every n-th element, so that at most `most` are left, and always the last one.
template <class Item>
std::vector<Item> thinned(const std::vector<Item>& items, std::size_t most) {
  if (items.size() <= most) return items;
  std::vector<Item> kept;
  const double stride = static_cast<double>(items.size() - 1) / static_cast<double>(most - 1);
  for (std::size_t i = 0; i < most; ++i) {
    kept.push_back(items[static_cast<std::size_t>(std::lround(stride * static_cast<double>(i)))]);
  }
  return kept;
}

/// Gathers run 0 for a picture: scan by scan, one tracker per contender.
class ExampleRecorder {
 public:
  explicit ExampleRecorder(const Trial& trial)
      : trial_(trial), tracks_(trial.contenders().size()) {
    for (std::size_t i = 0; i < tracks_.size(); ++i) trackers_.push_back(trial.tracker(i));
    for (const ObjectInfo& object : trial.objects()) {
      example_.truth.push_back({object.name, object.regime, {}});
    }
  }

  void sense(const SensedScan& scan) {
    for (const TruthState& object : scan.truth->objects) {
      example_.truth[static_cast<std::size_t>(object.id)].points.push_back(
          point(scan.truth->time, object.position));
    }
    const Observation& observation = scan.observation;
    for (std::size_t i = 0; i < observation.origins.size(); ++i) {
      auto& points =
          observation.origins[i] == kClutterOrigin ? example_.clutter : example_.detections;
      points.push_back(point(scan.truth->time, observation.scan.detections[i].position));
    }
  }

  void track(const SensedScan& sensed) {
    for (std::size_t i = 0; i < trackers_.size(); ++i) {
      trackers_[i].step(sensed.observation);
      const TrackSnapshot now = trackers_[i].snapshot();
      for (const TrackEstimate& track : now.tracks) {
        if (track.status == TrackStatus::kTentative) continue;
        tracks_[i][track.id].push_back(point(now.time, track.position));
      }
    }
  }

  /// At most so many points in all, shared out evenly.
  ExampleRun example() && {
    constexpr std::size_t kMostPaths = 30;
    constexpr std::size_t kMostPoints = 1500;  // of each kind, and of each contender
    const auto each = [](std::size_t paths) {
      return std::max<std::size_t>(2, kMostPoints / std::max<std::size_t>(1, paths));
    };
    std::erase_if(example_.truth, [](const ExampleRun::Path& path) { return path.points.empty(); });
    if (example_.truth.size() > kMostPaths) example_.truth.resize(kMostPaths);
    for (ExampleRun::Path& path : example_.truth) {
      path.points = thinned(path.points, std::min<std::size_t>(200, each(example_.truth.size())));
    }
    example_.detections = thinned(example_.detections, 600);
    example_.clutter = thinned(example_.clutter, 200);
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      ExampleRun::Estimate& estimate = example_.estimates.emplace_back();
      estimate.filter = i;
      for (const auto& [id, points] : tracks_[i]) {
        if (estimate.tracks.size() == kMostPaths) break;
        estimate.tracks.push_back(
            thinned(points, std::min<std::size_t>(200, each(tracks_[i].size()))));
      }
    }
    return std::move(example_);
  }

 private:
  static ExampleRun::Point point(double time, const Vec2& position) {
    return {time, position.x(), position.y()};
  }

  const Trial& trial_;
  std::vector<SceneTracker> trackers_;
  std::vector<std::map<int, std::vector<ExampleRun::Point>>> tracks_;  // by contender and track
  ExampleRun example_;
};

/// Those of the objects that belong to a regime.
std::vector<SightedObject> objects_of(const std::vector<SightedObject>& objects,
                                      const Subject& regime) {
  std::vector<SightedObject> chosen;
  std::copy_if(objects.begin(), objects.end(), std::back_inserter(chosen),
               [&](const SightedObject& object) { return belongs_to(object.id, regime); });
  return chosen;
}

GainSurface surface_of(const Trial& trial, const std::string& regime,
                       const std::vector<SightedObject>& objects) {
  GainSurface surface{.regime = regime, .g = {}, .h = {}, .rmse = {}, .best = {}, .marks = {}};
  for (std::size_t i = 0; i < kGridSide; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kGridSide - 1);
    surface.g.push_back(0.02 + 0.98 * share);
    surface.h.push_back(std::pow(10.0, -4.0 + 4.0 * share));
  }
  double least = std::numeric_limits<double>::infinity();
  for (const double g : surface.g) {
    for (const double h : surface.h) {
      const Gains gains = Gains::of_gh(g, h);
      ErrorSum sum;
      if (is_stable(gains)) {
        const GainFilter<2> filter =
            plain_filter(gains, trial.scoring().sigma, trial.scoring().period);
        for (const SightedObject& object : objects) sum += expected_errors(filter, object);
      }
      surface.rmse.push_back(sum.rmse_position());
      if (!(surface.rmse.back() < least)) continue;
      least = surface.rmse.back();
      surface.best = gains;
    }
  }
  for (std::size_t i = 0; i < trial.contenders().size(); ++i) {
    const Filter& filter = trial.design(i).filter_for(regime, 0);
    const Gains gains = steady_gains(filter);
    if (name(filter) == "gh") surface.marks.push_back({i, gains});
  }
  return surface;
}

}  // namespace

std::vector<SubjectTheory> theory_of(const Trial& trial) {
  const std::vector<GainFilter<2>> filters = candidates(trial.scoring());
  std::vector<TheorySum> of_objects(trial.objects().size());
  const std::vector<ObjectId> objects = some_objects(trial, kTheorySightings);
  const int runs = std::min(kTheoryRuns, trial.scene().compare.runs);
  for (int run = 0; run < runs; ++run) {
    for (const SightedObject& object : sightings_of(trial, run, objects)) {
      of_objects[static_cast<std::size_t>(object.id)].add(object, filters);
    }
  }
  std::vector<SubjectTheory> theory;
  for (const Subject& subject : trial.subjects()) {
    TheorySum sum;
    for (const ObjectId id : subject.objects) {
      const TheorySum& object = of_objects[static_cast<std::size_t>(id)];
      if (object.scans > 0) sum += object;
    }
    theory.push_back(sum.theory());
  }
  return theory;
}

std::vector<GainSurface> gain_surfaces(const Trial& trial) {
  const std::vector<SightedObject> objects =
      sightings_of(trial, 0, some_objects(trial, kSurfaceSightings));
  std::vector<GainSurface> surfaces;
  for (const Subject& subject : trial.subjects()) {
    if (subject.regime.empty() || !subject.object.empty()) continue;
    const std::vector<SightedObject> own = objects_of(objects, subject);
    if (!own.empty()) surfaces.push_back(surface_of(trial, subject.regime, own));
  }
  return surfaces;
}

ExampleRun example_of(const Trial& trial) {
  const WorldScene scene = scene_of_run(trial.scene(), 0);
  const Setting setting{.objects = trial.objects(), .classes = regime_kinds(), .seed = scene.seed};
  ExampleRecorder recorder(trial);
  sense(
      scene, setting, trial.truth_of(0), [&](const SensedScan& scan) { recorder.sense(scan); },
      [&](const SensedScan& scan) { recorder.track(scan); });
  return std::move(recorder).example();
}

}  // namespace ghtrack

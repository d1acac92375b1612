#include "tools/experiment/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "tools/experiment/engine.hpp"
#include "tools/experiment/labelled_objects.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kIndices = 19;   // tracking indices 10^-3.5, … 10^2.5
constexpr std::size_t kGridSide = 20;  // of a gain surface
constexpr std::size_t kTheoryScans = 100'000;  // of each run
constexpr std::size_t kSurfaceScans = 4000;

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
  std::vector<SquaredErrors> candidates;
  double square_acceleration = 0.0;
  double square_jerk = 0.0;
  std::int64_t scans = 0;
  std::int64_t steps = 0;

  void add(const LabelledObject& object) {
    const TruthState* before = nullptr;
    double before_time = 0.0;
    for (const ObjectScan& scan : object.scans) {
      square_acceleration += scan.truth.acceleration.squaredNorm();
      ++scans;
      if (before != nullptr && scan.time > before_time) {
        const Vec2 change = scan.truth.acceleration - before->acceleration;
        square_jerk += (change / (scan.time - before_time)).squaredNorm();
        ++steps;
      }
      before = &scan.truth;
      before_time = scan.time;
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
    for (const SquaredErrors& candidate : candidates) {
      if (!candidate.position.root()) continue;
      const double position = *candidate.position.root();
      const double velocity = *candidate.velocity.root();
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

/// Gathers a run for a picture.
class ExampleRecorder final : public RunObserver {
 public:
  explicit ExampleRecorder(const Trial& trial) : tracks_(trial.contenders().size()) {
    for (const ObjectInfo& object : trial.objects()) {
      example_.truth.push_back({object.name, object.regime, {}});
    }
  }

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override {
    for (const TruthState& object : truth.objects) {
      example_.truth[static_cast<std::size_t>(object.id)].points.push_back(
          point(truth.time, object.position));
    }
    for (std::size_t i = 0; i < observation.origins.size(); ++i) {
      auto& points =
          observation.origins[i] == kClutterOrigin ? example_.clutter : example_.detections;
      points.push_back(point(truth.time, observation.scan.detections[i].position));
    }
  }

  void add_tracks(const StepRecord& record) override {
    for (const TrackEstimate& track : record.tracks.tracks) {
      if (track.status == TrackStatus::kTentative) continue;
      tracks_[record.contender][track.id].push_back(point(record.tracks.time, track.position));
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

  std::vector<std::map<int, std::vector<ExampleRun::Point>>> tracks_;  // by contender and track
  ExampleRun example_;
};

/// Those of the objects that belong to a regime.
std::vector<LabelledObject> objects_of(const std::vector<LabelledObject>& objects,
                                      const Subject& regime) {
  std::vector<LabelledObject> chosen;
  std::copy_if(objects.begin(), objects.end(), std::back_inserter(chosen),
               [&](const LabelledObject& object) { return belongs_to(object.id, regime); });
  return chosen;
}

GainSurface surface_of(const Trial& trial, const std::string& regime,
                       const std::vector<LabelledObject>& objects, int jobs) {
  GainSurface surface{.regime = regime, .g = {}, .h = {}, .rmse = {}, .best = {}, .marks = {}};
  for (std::size_t i = 0; i < kGridSide; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kGridSide - 1);
    surface.g.push_back(0.02 + 0.98 * share);
    surface.h.push_back(std::pow(10.0, -4.0 + 4.0 * share));
  }
  surface.rmse.resize(kGridSide * kGridSide);
  in_parallel(surface.rmse.size(), jobs, [&](std::size_t i) {
    const Gains gains = Gains::of_gh(surface.g[i / kGridSide], surface.h[i % kGridSide]);
    SquaredErrors sum;
    if (is_stable(gains)) {
      const GainFilter<2> filter =
          plain_filter(gains, trial.scoring().sigma, trial.scoring().period);
      for (const LabelledObject& object : objects) sum += expected_errors(filter, object);
    }
    surface.rmse[i] = or_nan(sum.position.root());
  });
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surface.rmse.size(); ++i) {
    if (!(surface.rmse[i] < least)) continue;
    least = surface.rmse[i];
    surface.best = Gains::of_gh(surface.g[i / kGridSide], surface.h[i % kGridSide]);
  }
  for (std::size_t i = 0; i < trial.contenders().size(); ++i) {
    const Filter& filter = trial.design(i).filter_for(regime, 0);
    if (name(filter) == "gh") surface.marks.push_back({i, *steady_gains(filter)});
  }
  return surface;
}

}  // namespace

int theory_runs(const WorldScene& scene) {
  return std::min(SharedTruth::kKeptRuns, scene.compare.runs);
 }

std::vector<SubjectTheory> theory_of(const Trial& trial, std::span<const RunTruth> truths,
                                     int jobs) {
  const std::vector<GainFilter<2>> filters = candidates(trial.scoring());
  std::vector<TheorySum> of_objects(trial.objects().size());
  for (TheorySum& sum : of_objects) sum.candidates.resize(filters.size());
  const std::vector<ObjectId> wanted = some_objects(trial, kTheoryScans);
  for (std::size_t run = 0; run < truths.size(); ++run) {
    const std::vector<LabelledObject> objects =
        labelled_objects(trial, static_cast<int>(run), truths[run], wanted);
    in_parallel(objects.size() * filters.size(), jobs, [&](std::size_t i) {
      const LabelledObject& object = objects[i / filters.size()];
      const std::size_t filter = i % filters.size();
      of_objects[static_cast<std::size_t>(object.id)].candidates[filter] +=
          expected_errors(filters[filter], object);
    });
    for (const LabelledObject& object : objects) {
      of_objects[static_cast<std::size_t>(object.id)].add(object);
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

std::vector<GainSurface> gain_surfaces(const Trial& trial, const RunTruth& truth, int jobs) {
  const std::vector<LabelledObject> objects =
      labelled_objects(trial, 0, truth, some_objects(trial, kSurfaceScans));
  std::vector<GainSurface> surfaces;
  for (const Subject& subject : trial.subjects()) {
    if (subject.regime.empty() || !subject.object.empty()) continue;
    const std::vector<LabelledObject> own = objects_of(objects, subject);
    if (!own.empty()) surfaces.push_back(surface_of(trial, subject.regime, own, jobs));
  }
  return surfaces;
}

ExampleRun example_of(const Trial& trial, const RunTruth& truth) {
  ExampleRecorder recorder(trial);
  trial.listen(0, *truth.source(), trial.contenders(), {&recorder});
  return std::move(recorder).example();
}

}  // namespace ghtrack

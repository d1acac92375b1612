#include "tools/experiment/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "tools/experiment/labelled_objects.hpp"
#include "tools/experiment/parallel.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

constexpr int kTheoryRuns = 200;
constexpr int kRunsOfOneTruth = 25;
constexpr std::size_t kGridSide = 20;         // of a gain surface
constexpr std::size_t kTheoryScans = 60'000;  // of all runs
constexpr std::size_t kSurfaceScans = 4000;

bool belongs_to(ObjectId id, const Subject& subject) {
  return std::binary_search(subject.objects.begin(), subject.objects.end(), id);
}

/// Sums over the truth of some objects.
class TruthSums {
 public:
  void add(const LabelledObject& object) {
    const TruthState* before = nullptr;
    double before_time = 0.0;
    for (const ObjectScan& scan : object.scans) {
      acceleration_.add(scan.truth.acceleration.squaredNorm());
      if (before != nullptr && scan.time > before_time) {
        const Vec2 change = scan.truth.acceleration - before->acceleration;
        jerk_.add((change / (scan.time - before_time)).squaredNorm());
        autocorrelation_.add(scan.truth.acceleration.dot(before->acceleration));
      }
      before = &scan.truth;
      before_time = scan.time;
    }
  }

  void write(SubjectTheory& theory) const {
    theory.square_acceleration = acceleration_.value().value_or(0.0);
    theory.square_jerk = jerk_.value().value_or(0.0);
    theory.square_autocorrelation = autocorrelation_.value().value_or(0.0);
  }

 private:
  Mean acceleration_, jerk_, autocorrelation_;
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

int theory_runs(const WorldScene& scene, int runs) {
  return std::min(runs, truth_is_fixed(scene) ? kRunsOfOneTruth : kTheoryRuns);
}

std::vector<SubjectTheory> theory_of(const Trial& trial, const SharedTruth& truth, int first_run,
                                     int runs, int jobs) {
  const int some = theory_runs(trial.scene(), runs);
  const std::vector<ObjectId> wanted =
      some_objects(trial, kTheoryScans / static_cast<std::size_t>(some));
  std::vector<std::vector<LabelledObject>> of_runs(static_cast<std::size_t>(some));
  in_parallel(of_runs.size(), jobs, [&](std::size_t i) {
    const int run = first_run + static_cast<int>(i);
    of_runs[i] = labelled_objects(trial, run, truth.of_run(run, false), wanted);
  });
  // The only object of a scene is all of its regime and of the scene, too.
  const std::vector<Subject>& subjects = trial.subjects();
  const auto same_objects = [&](std::size_t i) {
    return std::find_if(
               subjects.begin(), subjects.end(),
               [&](const Subject& other) { return other.objects == subjects[i].objects; }) -
           subjects.begin();
  };
  const std::vector<std::optional<RandomMotion>> motions =
      random_motions(trial.scene(), Runs::kMany);
  std::vector<SubjectTheory> theory(subjects.size());
  in_parallel(theory.size(), jobs, [&](std::size_t i) {
    if (same_objects(i) < static_cast<std::ptrdiff_t>(i)) return;
    ObjectsOfRuns objects;
    TruthSums sums;
    for (const std::vector<LabelledObject>& run : of_runs) {
      for (const LabelledObject& object : run) {
        if (!belongs_to(object.id, subjects[i])) continue;
        objects.push_back(&object);
        sums.add(object);
      }
    }
    sums.write(theory[i]);
    theory[i].hindsight = in_hindsight(objects, trial.scene().sensors, motions, trial.scoring(),
                                       [&] { trial.step(); });
  });
  for (std::size_t i = 0; i < theory.size(); ++i) {
    theory[i] = theory[static_cast<std::size_t>(same_objects(i))];
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

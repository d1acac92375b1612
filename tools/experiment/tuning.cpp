#include "tools/experiment/tuning.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "tools/experiment/analysis.hpp"
#include "tools/experiment/engine.hpp"
#include "tools/experiment/gain_search.hpp"
#include "tools/experiment/labelled_objects.hpp"
#include "tools/experiment/statistics.hpp"
#include "tools/experiment/trial.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostScans = 200'000;  // that one evaluation goes through, of all regimes

/// One regime's objects in several runs.
using Runs = std::vector<std::vector<LabelledObject>>;

/// The filter that a scene makes of {gh: {g: …, h: …}}.
Filter filter_with(const Gains& gains, const RunMetricsOptions& sensor) {
  if (gains.order == 1) {
    return make_filter(GhConfig{.design = gain_design::Manual<1>{gains.g, gains.h, 0.0}},
                       sensor.sigma, sensor.period);
  }
  return make_filter(GhkConfig{.design = gain_design::Manual<2>{gains.g, gains.h, gains.k}},
                     sensor.sigma, sensor.period);
}

/// RMSE of each run; NaN where nothing was seen.
std::vector<double> rmse_of_runs(const Filter& filter, const Runs& runs) {
  std::vector<double> all;
  for (const std::vector<LabelledObject>& run : runs) {
    SquaredErrors sum;
    for (const LabelledObject& object : run) sum += measured_errors(filter, object);
    all.push_back(or_nan(sum.position.root()));
  }
  return all;
}

double pooled_rmse(const Filter& filter, const Runs& runs) {
  SquaredErrors sum;
  for (const std::vector<LabelledObject>& run : runs) {
    for (const LabelledObject& object : run) sum += measured_errors(filter, object);
  }
  return or_nan(sum.position.root());
}

/// A filter that is to be judged.
struct Candidate {
  std::string origin;
  Filter filter;
};

/// Tunes and judges one regime.
class RegimeTuner {
 public:
  RegimeTuner(const Trial& trial, const std::string& regime, Runs training, Runs judging,
              const TuningOptions& options)
      : trial_(trial),
        sensor_(trial.scoring()),
        regime_(regime),
        training_(std::move(training)),
        judging_(std::move(judging)),
        options_(options) {}

  TunedRegime result(const SubjectTheory& theory) const {
    TunedRegime tuned;
    tuned.regime = regime_;
    tuned.acceleration = std::sqrt(0.5 * theory.square_acceleration);
    tuned.tracking_index = tracking_index(tuned.acceleration, sensor_.sigma, sensor_.period);
    tuned.bound = theory.bound_position;

    std::vector<Candidate> candidates;
    double least = std::numeric_limits<double>::infinity();
    for (const int order : options_.orders) {
      const FoundGains found = search(order);
      candidates.push_back({"tuned", filter_with(found.gains, sensor_)});
      if (!(found.cost < least)) continue;
      least = found.cost;
      tuned.best = found.gains;
    }
    const std::vector<double> winner = rmse_of_runs(filter_with(tuned.best, sensor_), judging_);
    add_designs(theory, candidates);
    add_named_filters(candidates);
    for (const Candidate& candidate : candidates) {
      tuned.judged.push_back(judge(candidate, winner));
    }
    return tuned;
  }

 private:
  FoundGains search(int order) const {
    const GainFamily family =
        options_.rule ? *gains_of_rule(*options_.rule, order) : stable_gains(order);
    return least_cost(family, [&](const Gains& gains) {
      trial_.step();
      const double rmse = pooled_rmse(filter_with(gains, sensor_), training_);
      return std::isfinite(rmse) ? rmse : std::numeric_limits<double>::infinity();
    });
  }

  /// Gains by rule, from the regime's own statistics: Kalata's for its accelerations, and the other
  /// rules' at the same g.
  void add_designs(const SubjectTheory& theory, std::vector<Candidate>& candidates) const {
    for (const int order : options_.orders) {
      const double jump = order == 1 ? std::sqrt(0.5 * theory.square_acceleration)
                                     : sensor_.period * std::sqrt(0.5 * theory.square_jerk);
      const double index =
          std::clamp(tracking_index(jump, sensor_.sigma, sensor_.period), 1e-5, 1e3);
      const Gains kalata = tracking_index_gains(order, index);
      const double theta = order == 1 ? std::sqrt(1.0 - kalata.g) : std::cbrt(1.0 - kalata.g);
      candidates.push_back({"tracking-index", filter_with(kalata, sensor_)});
      candidates.push_back({"benedict-bordner",
                            filter_with(order == 1 ? benedict_bordner_gains(kalata.g)
                                                   : third_order_benedict_bordner_gains(kalata.g),
                                        sensor_)});
      candidates.push_back(
          {"critical-damping", filter_with(fading_memory_gains(order, theta), sensor_)});
    }
  }

  /// What the scene would use, and what it compares.
  void add_named_filters(std::vector<Candidate>& candidates) const {
    TrackerConfig config = trial_.scene().tracker;
    config.association = Association::kNearestGlobal;  // filters do not depend on it
    const TrackerDesign own(std::move(config), traits_of(trial_.scene().sensors));
    candidates.push_back({"tracker", own.filter_for(regime_, 0)});
    for (std::size_t i = 0; i < trial_.contenders().size(); ++i) {
      if (trial_.scene().compare.filters.empty()) break;
      candidates.push_back({trial_.contenders()[i].name, trial_.design(i).filter_for(regime_, 0)});
    }
  }

  JudgedGains judge(const Candidate& candidate, const std::vector<double>& winner) const {
    const std::vector<double> rmse = rmse_of_runs(candidate.filter, judging_);
    const SampleMean mean = mean_of(rmse, Average::kRootMeanSquare);
    const PairedDifference difference = paired_difference(rmse, winner, Average::kRootMeanSquare, 0.95);
    const bool several = std::holds_alternative<MultipleModelFilter>(candidate.filter);
    return {.origin = candidate.origin,
            .filter = several ? "multiple-model" : std::string(name(candidate.filter)),
            .gains = several ? "" : gains_text(candidate.filter),
            .trained_rmse = pooled_rmse(candidate.filter, training_),
            .rmse = mean.mean,
            .ci95 = mean.ci95,
            .difference = difference.value,
            .difference_ci95 = difference.interval};
  }

  const Trial& trial_;
  const RunMetricsOptions& sensor_;
  std::string regime_;
  Runs training_;
  Runs judging_;
  const TuningOptions& options_;
};

/// The objects of one regime in all runs.
Runs runs_of(const Runs& all, const Subject& regime) {
  Runs chosen;
  for (const std::vector<LabelledObject>& run : all) {
    std::copy_if(run.begin(), run.end(), std::back_inserter(chosen.emplace_back()),
                 [&](const LabelledObject& object) {
                   return std::binary_search(regime.objects.begin(), regime.objects.end(),
                                             object.id);
                 });
  }
  return chosen;
}

Runs labelled_runs(const Trial& trial, int first, const TuningOptions& options) {
  Runs runs(static_cast<std::size_t>(options.runs));
  const std::vector<ObjectId> objects = some_objects(trial, kMostScans / runs.size());
  in_parallel(runs.size(), options.jobs, [&](std::size_t i) {
    const int run = first + static_cast<int>(i);
    runs[i] = labelled_objects(trial, run, trial.truth_of(run), objects);
  });
  return runs;
}

}  // namespace

Tuning tune(const WorldScene& scene, const TuningOptions& options,
            const std::function<void()>& on_step) {
  for (const int order : options.orders) {
    if (options.rule && !gains_of_rule(*options.rule, order)) {
      throw std::invalid_argument("there is no family of gains called '" + *options.rule + "'");
    }
  }
  const Trial trial(scene, on_step);
  const Runs training = labelled_runs(trial, kFirstTuningRun, options);
  const Runs judging = labelled_runs(trial, kFirstJudgingRun, options);
  std::vector<RunTruth> truths;
  for (int run = 0; run < theory_runs(scene); ++run) truths.push_back(trial.truth_of(run, true));
  const std::vector<SubjectTheory> theory = theory_of(trial, truths, options.jobs);

  std::vector<std::size_t> regimes;  // among the subjects
  for (std::size_t i = 0; i < trial.subjects().size(); ++i) {
    const Subject& subject = trial.subjects()[i];
    if (!subject.regime.empty() && subject.object.empty()) regimes.push_back(i);
  }
  Tuning tuning;
  tuning.scene = scene.name;
  tuning.runs = options.runs;
  tuning.sigma = trial.scoring().sigma;
  tuning.period = trial.scoring().period;
  tuning.regimes.resize(regimes.size());
  in_parallel(regimes.size(), options.jobs, [&](std::size_t i) {
    const Subject& subject = trial.subjects()[regimes[i]];
    tuning.regimes[i] = RegimeTuner(trial, subject.regime, runs_of(training, subject),
                                    runs_of(judging, subject), options)
                            .result(theory[regimes[i]]);
  });
  tuning.surfaces = gain_surfaces(trial, truths.front(), options.jobs);
  return tuning;
}

}  // namespace ghtrack

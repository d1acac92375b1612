#include "tools/experiment/trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sensors/sensor.hpp"
#include "tools/metrics/mean.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostListed = 50;  // objects that get rows of their own

std::vector<std::string> regimes_of(const std::vector<ObjectInfo>& objects) {
  std::vector<std::string> regimes;
  for (const ObjectInfo& object : objects) {
    if (std::find(regimes.begin(), regimes.end(), object.regime) == regimes.end()) {
      regimes.push_back(object.regime);
    }
  }
  return regimes;
}

std::vector<Subject> subjects_of(const std::vector<ObjectInfo>& objects,
                                 const std::vector<std::string>& regimes) {
  std::vector<Subject> subjects;
  if (objects.size() <= kMostListed) {
    for (const ObjectInfo& object : objects) {
      subjects.push_back({object.regime, object.name, {object.id}});
    }
  }
  Subject everything;
  for (const std::string& regime : regimes) {
    Subject all{regime, "", {}};
    for (const ObjectInfo& object : objects) {
      if (object.regime == regime) all.objects.push_back(object.id);
    }
    subjects.push_back(std::move(all));
  }
  for (const ObjectInfo& object : objects) everything.objects.push_back(object.id);
  subjects.push_back(std::move(everything));
  return subjects;
}

/// What one contender yields in a run.
class ContenderScores final : public RunObserver {
 public:
  ContenderScores(const Trial& trial, std::size_t contender)
      : trial_(trial),
        contender_(contender),
        metrics_(trial.objects(), trial.scoring(), contender,
                 FilterTheory{trial.design(contender), trial.scene().sensors}),
        bins_(trial.regimes().size() * TrialLayout::kBins) {
    for (const ObjectInfo& object : trial.objects()) {
      const auto found = std::find(trial.regimes().begin(), trial.regimes().end(), object.regime);
      regime_of_.push_back(static_cast<std::size_t>(found - trial.regimes().begin()));
    }
  }

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override {
    metrics_.add_observation(truth, observation);
  }

  void add_tracks(const StepRecord& record) override {
    if (record.contender != contender_) return;
    metrics_.add_tracks(record);
    if (!record.is_in_order()) return;
    const double share = record.truth.time / trial_.scene().duration;
    const std::size_t bin = std::min(TrialLayout::kBins - 1,
                                     static_cast<std::size_t>(share * double{TrialLayout::kBins}));
    for (std::size_t i = 0; i < regime_of_.size(); ++i) {
      if (const auto& error = metrics_.latest_errors()[i]) {
        bins_[regime_of_[i] * TrialLayout::kBins + bin].add(error->squaredNorm());
      }
    }
  }

  void add_known(const TruthSnapshot& truth, const TrackSnapshot& tracks,
                 std::size_t contender) override {
    metrics_.add_known(truth, tracks, contender);
  }

  void write_scores(std::vector<double>& scores) {
    const TrialLayout layout = trial_.layout();
    const RunReport report = metrics_.report();
    for (std::size_t i = 0; i < trial_.subjects().size(); ++i) {
      const Subject& subject = trial_.subjects()[i];
      const SubjectReport of_subject{report, subject.objects, subject.regime.empty()};
      for (const Metric metric : all_metrics()) {
        const MetricInfo& how = info(metric);
        scores[layout.value(contender_, i, metric)] = how.value(of_subject);
        if (how.predicted == nullptr) continue;
        scores[layout.predicted(contender_, i, metric)] = how.predicted(of_subject);
      }
    }
    for (std::size_t regime = 0; regime < trial_.regimes().size(); ++regime) {
      for (std::size_t bin = 0; bin < TrialLayout::kBins; ++bin) {
        scores[layout.curve(contender_, regime, bin)] =
            or_nan(bins_[regime * TrialLayout::kBins + bin].value());
      }
    }
  }

 private:
  const Trial& trial_;
  std::size_t contender_;
  RunMetrics metrics_;
  std::vector<std::size_t> regime_of_;  // by object
  std::vector<Mean> bins_;              // by regime and time
};

/// Counts the scans of a run as steps of work.
class StepCounter final : public RunObserver {
 public:
  explicit StepCounter(const Trial& trial) : trial_(trial) {}
  void add_observation(const TruthSnapshot&, const Observation&) override { trial_.step(); }

 private:
  const Trial& trial_;
};

}  // namespace

TrialLayout layout_of(const WorldScene& scene) {
  const std::vector<ObjectInfo> objects = world_of_run(scene, 0).objects();
  const std::vector<std::string> regimes = regimes_of(objects);
  return {compared_filters(scene).size(), subjects_of(objects, regimes).size(), regimes.size()};
}

Trial::Trial(const WorldScene& scene, std::function<void()> on_step)
    : scene_(scene),
      on_step_(std::move(on_step)),
      contenders_(compared_filters(scene)),
      scoring_(scoring_for(traits_of(scene.sensors))),
      truth_(scene, on_step_) {
  objects_ = world_of_run(scene, 0).objects();
  regimes_ = regimes_of(objects_);
  subjects_ = subjects_of(objects_, regimes_);
}

void Trial::listen(int run, TruthSource& truth, std::span<const Contender> contenders,
                   RunObservers observers, std::span<const double> frame_times) const {
  StepCounter steps(*this);
  observers.insert(observers.begin(), &steps);
  ghtrack::run(scene_of_run(scene_, run), truth, contenders, observers, frame_times);
}

std::vector<double> Trial::scores(int run, TruthSource& truth, RunObservers observers,
                                  std::span<const double> frame_times) const {
  std::vector<ContenderScores> all;
  for (std::size_t i = 0; i < contenders_.size(); ++i) all.emplace_back(*this, i);
  for (ContenderScores& scores : all) observers.push_back(&scores);
  listen(run, truth, contenders_, std::move(observers), frame_times);
  std::vector<double> scores(layout().size(), kNothing);
  for (ContenderScores& contender : all) contender.write_scores(scores);
  return scores;
}

std::vector<double> Trial::scores(int run) const {
  return scores(run, *truth_of(run).source(), {});
}

}  // namespace ghtrack

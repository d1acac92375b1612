#include "tools/experiment/trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sensors/sensor.hpp"
#include "tools/pipeline/simulation.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostListed = 50;                   // objects that get rows of their own
constexpr std::size_t kMostRecorded = 512 * 1024 * 1024;  // bytes of truth
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

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

/// A mean over objects, each weighed by how many values it stands for.
class WeightedMean {
 public:
  void add(const std::optional<double>& value, double weight = 1.0) {
    if (!value || !(weight > 0.0)) return;
    sum_ += weight * *value;
    weight_ += weight;
  }
  double mean() const { return weight_ > 0.0 ? sum_ / weight_ : kNothing; }
  double root() const { return std::sqrt(mean()); }

 private:
  double sum_ = 0.0;
  double weight_ = 0.0;
};

std::optional<double> square(const std::optional<double>& value) {
  if (!value) return std::nullopt;
  return *value * *value;
}

/// One contender on its way through a run.
class Attempt {
 public:
  Attempt(const Trial& trial, std::size_t contender)
      : trial_(trial),
        contender_(contender),
        tracker_(trial.tracker(contender)),
        metrics_(trial.objects(), trial.scoring()),
        bins_(trial.regimes().size() * TrialLayout::kBins) {
    for (const ObjectInfo& object : trial.objects()) {
      const auto found = std::find(trial.regimes().begin(), trial.regimes().end(), object.regime);
      regime_of_.push_back(static_cast<std::size_t>(found - trial.regimes().begin()));
    }
  }

  void sense(const SensedScan& scan) { metrics_.add_observation(*scan.truth, scan.observation); }

  void track(const SensedScan& sensed) {
    if (tracker_.step(sensed.observation) != ScanFate::kProcessed) return;
    metrics_.add_tracks({*sensed.truth, sensed.observation, tracker_.snapshot()});
    const double share = sensed.observation.scan.time / trial_.scene().duration;
    const std::size_t bin = std::min(TrialLayout::kBins - 1,
                                     static_cast<std::size_t>(share * double{TrialLayout::kBins}));
    for (std::size_t i = 0; i < regime_of_.size(); ++i) {
      if (const auto& error = metrics_.latest_errors()[i]) {
        bins_[regime_of_[i] * TrialLayout::kBins + bin].add(error->squaredNorm());
      }
    }
  }

  void write_scores(std::vector<double>& scores) const {
    const TrialLayout layout = trial_.layout();
    const RunReport report = metrics_.report();
    for (std::size_t i = 0; i < trial_.subjects().size(); ++i) {
      write_subject(report, i, scores);
    }
    for (std::size_t regime = 0; regime < trial_.regimes().size(); ++regime) {
      for (std::size_t bin = 0; bin < TrialLayout::kBins; ++bin) {
        scores[layout.curve(contender_, regime, bin)] =
            bins_[regime * TrialLayout::kBins + bin].mean();
      }
    }
  }

 private:
  void write_subject(const RunReport& report, std::size_t index,
                     std::vector<double>& scores) const {
    const TrialLayout layout = trial_.layout();
    const Subject& subject = trial_.subjects()[index];
    WeightedMean position, velocity, lag, mai, nis, settling, tracked;
    WeightedMean predicted_position, predicted_velocity, predicted_lag, predicted_mai;
    double peak = kNothing;
    double losses = 0.0;
    for (const ObjectId id : subject.objects) {
      const ObjectReport& object = report.objects[static_cast<std::size_t>(id)];
      const auto scans = static_cast<double>(object.tracked);
      position.add(square(object.rmse_position), scans);
      velocity.add(square(object.rmse_velocity), scans);
      predicted_position.add(square(object.predicted_rmse), scans);
      predicted_velocity.add(square(object.predicted_velocity), scans);
      lag.add(object.lag, scans);
      predicted_lag.add(object.predicted_lag, scans);
      const auto updates = static_cast<double>(object.detections_used);
      mai.add(object.mai, updates);
      predicted_mai.add(object.predicted_mai, updates);
      nis.add(object.nis, updates);
      settling.add(object.settling_time);
      peak = std::fmax(peak, object.peak_error.value_or(kNothing));
      losses += static_cast<double>(object.track_losses);
      if (object.scans > 0) {
        tracked.add(scans / static_cast<double>(object.scans), static_cast<double>(object.scans));
      }
    }
    const auto set = [&](Metric metric, double value) {
      scores[layout.value(contender_, index, metric)] = value;
    };
    set(Metric::kRmsePosition, position.root());
    set(Metric::kRmseVelocity, velocity.root());
    set(Metric::kPeakError, peak);
    set(Metric::kSettlingTime, settling.mean());
    set(Metric::kLag, lag.mean());
    set(Metric::kMai, mai.mean());
    set(Metric::kNis, nis.mean());
    set(Metric::kTracked, tracked.mean());
    set(Metric::kTrackLosses, losses);
    const bool whole_scene = subject.regime.empty();
    set(Metric::kGospa, whole_scene ? report.total.gospa : kNothing);
    set(Metric::kIdSwitches,
        whole_scene ? static_cast<double>(report.total.mot.clear.id_switches) : kNothing);
    const auto predict = [&](Metric metric, double value) {
      scores[layout.predicted(contender_, index, metric)] = value;
    };
    predict(Metric::kRmsePosition, predicted_position.root());
    predict(Metric::kRmseVelocity, predicted_velocity.root());
    predict(Metric::kLag, predicted_lag.mean());
    predict(Metric::kMai, predicted_mai.mean());
    predict(Metric::kNis, 2.0);
  }

  const Trial& trial_;
  std::size_t contender_;
  SceneTracker tracker_;
  RunMetrics metrics_;
  std::vector<std::size_t> regime_of_;  // by object
  std::vector<WeightedMean> bins_;      // by regime and time
};

std::size_t bytes_of(const TruthSnapshot& truth) {
  return sizeof truth + truth.objects.size() * sizeof(TruthState) +
         truth.bodies.size() * sizeof(BodyPose);
}

}  // namespace

Trial::Trial(const WorldScene& scene, std::function<void()> on_step)
    : scene_(scene),
      on_step_(std::move(on_step)),
      contenders_(compared_filters(scene)),
      scoring_(scoring_for(traits_of(scene.sensors))) {
  scoring_.with_floor = false;
  for (const Contender& contender : contenders_) {
    TrackerConfig config = scene.tracker;
    config.filters = contender.filters;
    trackers_.emplace_back(std::move(config), traits_of(scene.sensors));
  }
  objects_ = world_of_run(scene, 0).objects();
  regimes_ = regimes_of(objects_);
  subjects_ = subjects_of(objects_, regimes_);
}

void Trial::record_truth() {
  if (!truth_is_fixed(scene_)) return;
  World world = world_of_run(scene_, 0);
  ScanSchedule schedule(scene_);
  std::size_t bytes = 0;
  for (auto scan = schedule.next(); scan; scan = schedule.next()) {
    step();
    schedule.take(*scan);
    truth_.push_back(std::make_shared<const TruthSnapshot>(world.sample(scan->time)));
    bytes += bytes_of(*truth_.back());
    if (bytes <= kMostRecorded) continue;
    truth_.clear();
    return;
  }
}

TruthSource Trial::truth_of(int run) const {
  if (!truth_.empty()) {
    return [this, next = truth_.begin()](double /*time*/) mutable {
      step();
      return *next++;
    };
  }
  const auto world = std::make_shared<World>(world_of_run(scene_, run));
  return [this, world](double time) {
    step();
    return std::make_shared<const TruthSnapshot>(world->sample(time));
  };
}

std::vector<double> Trial::scores(int run) const {
  const WorldScene scene = scene_of_run(scene_, run);
  const Setting setting{.objects = objects_, .classes = regime_kinds(), .seed = scene.seed};
  std::vector<Attempt> attempts;
  for (std::size_t i = 0; i < contenders_.size(); ++i) attempts.emplace_back(*this, i);
  sense(
      scene, setting, truth_of(run),
      [&](const SensedScan& scan) {
        for (Attempt& attempt : attempts) attempt.sense(scan);
      },
      [&](const SensedScan& scan) {
        for (Attempt& attempt : attempts) attempt.track(scan);
      });
  std::vector<double> scores(layout().size(), kNothing);
  for (const Attempt& attempt : attempts) attempt.write_scores(scores);
  return scores;
}

}  // namespace ghtrack

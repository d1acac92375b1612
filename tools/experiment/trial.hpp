#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/experiment/campaign.hpp"
#include "tools/experiment/metric.hpp"
#include "tools/experiment/shared_truth.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/run/run.hpp"

namespace ghtrack {

/// Whom the metrics of a cell are about, in this order: its objects one by one if they are few, its
/// regimes, the scene as a whole.
struct Subject {
  std::string regime;             // empty: the scene as a whole
  std::string object;             // empty: all objects of the regime
  std::vector<ObjectId> objects;  // that belong to it
};

/// What one run of a cell yields, as a flat list of numbers: what is stored, sent and averaged. NaN
/// is a value that did not occur.
class TrialLayout {
 public:
  static constexpr std::size_t kBins = 48;  // of a scene's time, for its error curves

  TrialLayout(std::size_t contenders, std::size_t subjects, std::size_t regimes)
      : contenders_(contenders), subjects_(subjects), regimes_(regimes) {}

  std::size_t size() const { return contenders_ * per_contender(); }

  std::size_t value(std::size_t contender, std::size_t subject, Metric metric) const {
    return contender * per_contender() + subject * kPerSubject + static_cast<std::size_t>(metric);
  }
  /// What the closed forms say of it; NaN for metrics that they do not cover.
  std::size_t predicted(std::size_t contender, std::size_t subject, Metric metric) const {
    return value(contender, subject, metric) + kMetrics;
  }
  /// Mean squared error of a regime's objects in a bin of time [m²].
  std::size_t curve(std::size_t contender, std::size_t regime, std::size_t bin) const {
    return contender * per_contender() + subjects_ * kPerSubject + regime * kBins + bin;
  }

 private:
  static constexpr std::size_t kPerSubject = 2 * kMetrics;
  std::size_t per_contender() const { return subjects_ * kPerSubject + regimes_ * kBins; }

  std::size_t contenders_;
  std::size_t subjects_;
  std::size_t regimes_;
};

/// The layout of a cell's results, without making it ready to run.
TrialLayout layout_of(const WorldScene& scene);

/// One cell of a campaign, ready to run. Constant operations are safe to use from several threads.
class Trial {
 public:
  /// @param on_step  called again and again by whatever takes long; may throw to give up
  /// @throws std::invalid_argument if a filter cannot be designed for the scene's sensors
  explicit Trial(
      const WorldScene& scene, std::function<void()> on_step = [] {});

  const WorldScene& scene() const { return scene_; }
  const std::vector<ObjectInfo>& objects() const { return objects_; }
  const std::vector<Contender>& contenders() const { return contenders_; }
  const std::vector<Subject>& subjects() const { return subjects_; }
  const std::vector<std::string>& regimes() const { return regimes_; }
  const TrackerDesign& design(std::size_t contender) const {
    return contenders_.at(contender).tracker.design();
  }
  const RunMetricsOptions& scoring() const { return scoring_; }
  TrialLayout layout() const { return {contenders_.size(), subjects_.size(), regimes_.size()}; }

  /// The truth of one run, for who does not share it with other cells.
  RunTruth truth_of(int run, bool is_reused = false) const { return truth_.of_run(run, is_reused); }
  const SharedTruth& truth() const { return truth_; }

  /// Runs every contender on the same detections and scores them.
  /// @return numbers as layout() says
  std::vector<double> scores(int run) const;

  /// The same while others listen.
  std::vector<double> scores(int run, TruthSource& truth, RunObservers observers,
                             std::span<const double> frame_times = {}) const;

  /// Lets others listen to a run; each of its scans is a step of work.
  /// @param contenders  all of them, or none if only the detections matter
  void listen(int run, TruthSource& truth, std::span<const Contender> contenders,
              RunObservers observers, std::span<const double> frame_times = {}) const;

  /// A step of work on this trial is done.
  void step() const { on_step_(); }

 private:
  WorldScene scene_;
  std::function<void()> on_step_;
  std::vector<ObjectInfo> objects_;
  std::vector<Contender> contenders_;
  std::vector<std::string> regimes_;
  std::vector<Subject> subjects_;
  RunMetricsOptions scoring_;
  SharedTruth truth_;
};

}  // namespace ghtrack

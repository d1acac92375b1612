#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/experiment/comparison.hpp"
#include "tools/experiment/labelled_objects.hpp"
#include "tracker/filters/filter_config.hpp"

// Gains for each regime of a scene, found on some seeds and judged on others.

namespace ghtrack {

struct TuningOptions {
  int runs = 50;                     // for finding, and as many others for judging
  std::vector<int> orders = {1, 2};  // of the filters: 1 g-h, 2 g-h-k; both: other kinds as well
  std::optional<std::string> rule;   // only gains of this rule, such as "benedict-bordner"
  int jobs = 1;
};

/// How good a filter turned out to be. All of them are told which detection is whose.
struct JudgedGains {
  std::string origin;  // "tuned", a design rule, "scene" for its own, or a filter named in it
  std::string filter;  // "gh", "ghk", …
  std::string gains;   // "g=0.4 h=0.1"
  double trained_rmse = 0.0;     // on the seeds that gains were tuned on [m]
  double rmse = 0.0;             // on the other ones [m]
  std::optional<Interval> ci95;  // of it
  double difference = 0.0;       // to the recommended one, paired by runs [m]
  std::optional<Interval> difference_ci95;
  std::string text;  // as a scene says it; empty if it is not a filter of its own
};

/// What was found for one regime.
struct TunedRegime {
  std::string regime;
  double acceleration = 0.0;        // root mean square per axis, of the truth [m/s²]
  double tracking_index = 0.0;      // acceleration · T² / σ
  Hindsight hindsight;              // on the judging runs
  double correlation_time = 0.0;    // of the acceleration [s]; 0: shorter than a scan
  Gains best;                       // of the recommended filter, in the steady state
  std::vector<JudgedGains> judged;  // tuned, designed, of the scene, named in it
  std::size_t recommended = 0;      // among them: the least error in judging, but the scene's own
                                    // unless another one is better beyond chance
};

struct Tuning {
  std::string scene;
  int runs = 0;
  double sigma = 0.0;   // of a detection per axis [m]
  double period = 0.0;  // between scans [s]
  std::vector<TunedRegime> regimes;
  std::vector<GainSurface> surfaces;
};

/// Tunes filters for every regime of a scene, on runs of which no campaign is made, and judges them
/// on others still: g, g-h and g-h-k gains, tracking indices and Kalman filters, beside interacting
/// models, designs by rule and what the scene names. What is minimised is the mean squared error of
/// position from an object's third detection on; a table of least-squares gains serves the start,
/// as in a tracker.
/// @param on_step  called again and again by all threads; may throw to give up
/// @throws std::invalid_argument for a rule that has no family of gains
Tuning tune(
    const WorldScene& scene, const TuningOptions& options,
    const std::function<void()>& on_step = [] {});

/// Filters for all objects of a scene, each with what is best on some runs: g-h and g-h-k gains by
/// their expected error, Kalman filters of both kinds by their process noise, interacting ones
/// around the best of these.
/// @return by name: "tuned g-h", "tuned g-h-k", "tuned Kalman", "tuned IMM"
std::map<std::string, FilterConfig> tuned_filters(const Trial& trial, const LabelledRuns& runs,
                                                  std::span<const TunedKind> kinds);

/// The recommended filters as a part of a scene, to be pasted under `tracker`.
std::string scene_fragment(const Tuning& tuning);

nlohmann::ordered_json to_json(const Tuning& tuning);
/// For a terminal of so many columns, the best first.
std::string to_table(const Tuning& tuning, std::size_t width = 80);

}  // namespace ghtrack

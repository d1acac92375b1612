#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/data/point_reader.hpp"
#include "tools/metrics/gospa.hpp"
#include "tools/metrics/mot_score.hpp"
#include "tools/metrics/switches.hpp"
#include "tools/metrics/trajectory_gospa.hpp"

namespace ghtrack {

struct ScoreOptions {
  GospaOptions gospa;  // c in metres, or in pixels for boxes
  std::optional<double> match_distance =
      std::nullopt;  // of points, for MOTA, IDF1 and HOTA; c if not given

  std::optional<double> ospa_order = std::nullopt;  // 1 ≤ p ≤ ∞; GOSPA's p if not given
  std::optional<double> switching_penalty = std::nullopt;   // γ, for GOSPA with switches
  std::optional<double> trajectory_penalty = std::nullopt;  // γ of T-GOSPA; c / 5 if not given

  double matching() const { return match_distance.value_or(gospa.cutoff); }
  double order_of_ospa() const { return ospa_order.value_or(gospa.order); }
  double penalty_of_trajectories() const { return trajectory_penalty.value_or(gospa.cutoff / 5.0); }
};

/// What is there at one instant: objects, or tracks.
struct ScoredSet {
  std::vector<std::int64_t> ids;
  std::vector<Eigen::Vector2d> positions;
  std::vector<Box> boxes;  // as many; none where points are scored

  void clear();
  void add(std::int64_t id, const Eigen::Vector2d& position);
  void add(std::int64_t id, const Box& box);
};

/// The scores of one instant.
struct ScoreStep {
  double time = 0.0;  // [s], or the frame's number
  int truths = 0;
  int tracks = 0;
  double gospa = 0.0;
  double gospa_localisation = 0.0, gospa_missed = 0.0, gospa_false = 0.0;
  int missed = 0;
  int false_tracks = 0;
  double ospa = 0.0;
  double switches = 0.0;  // since the instant before, see SwitchCounter
};

/// How the instants of truth and tracks met.
struct InstantCounts {
  std::int64_t matched = 0;
  std::int64_t truth_alone = 0, tracks_alone = 0;        // scored as missed, or as false
  std::int64_t truth_unscored = 0, tracks_unscored = 0;  // between those of the other file
};

/// Scores of tracks against truth. What is per instant is a mean over the instants in which there
/// was a target or a track.
struct ScoreResult {
  ScoreOptions options;
  bool boxes = false;      // identity scores by IoU 0.5 rather than by distance
  std::string benchmark;   // whose rules left out rows of boxes; empty: none
  std::int64_t steps = 0;  // instants
  InstantCounts instants;
  double gospa = 0.0;
  double gospa_localisation = 0.0, gospa_missed = 0.0, gospa_false = 0.0;  // p-th powers
  double ospa = 0.0;
  double switches = 0.0;                  // in total
  std::optional<double> gospa_switching;  // GOSPA with switches; absent without a penalty
  std::optional<double> rmse;  // over the pairs of GOSPA's assignment; absent without any
  std::int64_t pairs = 0;      // of them
  std::optional<TrajectoryGospaResult> trajectories;  // T-GOSPA; absent if that is too large
  MotResult mot;
};

/// Scores instant by instant. Memory grows with the identities and, for T-GOSPA, with the meetings
/// of those that have rivals.
class Scorer {
 public:
  Scorer(const ScoreOptions& options, bool boxes);

  /// The scores of the instant, and GOSPA's assignment.
  struct Step {
    ScoreStep score;
    std::vector<PointMatch> matches;
  };
  Step add(double time, const ScoredSet& truth, const ScoredSet& tracks);

  ScoreResult result() const;

 private:
  ScoreOptions options_;
  MotScore mot_;
  SwitchCounter switches_;
  TrajectoryGospa trajectories_;
  ScoreResult sums_;
  double with_switches_ = 0.0;
  double squared_error_ = 0.0;
};

/// The scores of several sequences as if they were one: counts are added, means weighted by what
/// they are means of. T-GOSPA's powers are added. OSPA(2) has no such sum and is absent.
ScoreResult combine(std::span<const ScoreResult> results);

/// The scores as `ghtrack score --json` prints them; an absent value is null.
nlohmann::ordered_json to_json(const ScoreResult& result);

/// The scores as lines of text, for a terminal.
std::string to_text(const ScoreResult& result);

/// One row per instant, for a CSV file, and its header row.
std::string step_csv_header();
std::string step_csv_row(const ScoreStep& step);

}  // namespace ghtrack

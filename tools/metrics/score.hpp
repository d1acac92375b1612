#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/metrics/gospa.hpp"
#include "tools/metrics/mot_score.hpp"
#include "tools/record/csv_reader.hpp"
#include "tools/record/mot_file.hpp"

namespace ghtrack {

struct ScoreOptions {
  GospaOptions gospa;  // c in metres, or in pixels for boxes
  std::optional<double> match_distance =
      std::nullopt;  // of points, for MOTA, IDF1 and HOTA; c if not given

  std::optional<double> ospa_order = std::nullopt;  // 1 ≤ p ≤ ∞; GOSPA's p if not given
  std::optional<double> switching_penalty = std::nullopt;  // γ, for GOSPA with switches

  double matching() const { return match_distance.value_or(gospa.cutoff); }
  double order_of_ospa() const { return ospa_order.value_or(gospa.order); }
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

/// Scores of tracks against truth. What is per instant is a mean over the instants in which there
/// was a target or a track.
struct ScoreResult {
  ScoreOptions options;
  bool boxes = false;  // identity scores by IoU 0.5 rather than by distance
  double gospa = 0.0;
  double gospa_localisation = 0.0, gospa_missed = 0.0, gospa_false = 0.0;  // p-th powers
  double ospa = 0.0;
  double switches = 0.0;                  // in total
  std::optional<double> gospa_switching;  // GOSPA with switches; absent without a penalty
  std::optional<double> rmse;  // over the pairs of GOSPA's assignment; absent without any
  MotResult mot;
  std::vector<ScoreStep> steps;
};

/// Scores points. Both lists are ordered by time, as the readers give them; times that differ by
/// less than a billionth are the same instant.
ScoreResult score(std::span<const IdentifiedPoint> truth, std::span<const IdentifiedPoint> tracks,
                  const ScoreOptions& options);

/// Scores boxes: the identity scores by intersection over union, GOSPA and OSPA by the distance
/// between centres [pixel]. Both lists are ordered by frame.
ScoreResult score(std::span<const MotRow> truth, std::span<const MotRow> tracks,
                  const ScoreOptions& options);

/// The scores as `ghtrack score --json` prints them; an absent value is null.
nlohmann::ordered_json to_json(const ScoreResult& result);

/// The scores as lines of text, for a terminal.
std::string to_text(const ScoreResult& result);

/// A CSV file with one row per instant.
std::string per_step_csv(const ScoreResult& result);

}  // namespace ghtrack

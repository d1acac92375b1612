// `ghtrack score`: the metrics alone.

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/cli/commands.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/metrics/score.hpp"
#include "tools/record/atomic_file.hpp"

namespace ghtrack::cli {
namespace {

/// By default GOSPA's cut-off is 10 m, or 30 pixels between the centres of boxes.
constexpr double kBoxCutoff = 30.0;

double positive(const std::optional<double>& option, double fallback, const char* name) {
  const double value = option.value_or(fallback);
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw UsageError(fmt::format("score: {} is {}; it must be positive and finite", name, value));
  }
  return value;
}

ghtrack::ScoreOptions settings(const ScoreOptions& options, bool boxes) {
  ghtrack::ScoreOptions result;
  result.gospa.cutoff =
      positive(options.gospa_c, boxes ? kBoxCutoff : result.gospa.cutoff, "--gospa-c");
  result.gospa.order = positive(options.gospa_p, result.gospa.order, "--gospa-p");
  result.gospa.alpha = positive(options.gospa_alpha, result.gospa.alpha, "--gospa-alpha");
  if (result.gospa.order < 1.0) throw UsageError("score: --gospa-p must be at least 1");
  if (result.gospa.alpha > 2.0) throw UsageError("score: --gospa-alpha must be at most 2");
  if (options.gospa_switching) {
    result.switching_penalty = positive(options.gospa_switching, 0.0, "--gospa-switching");
  }
  if (options.ospa_p) {
    if (!(*options.ospa_p >= 1.0)) throw UsageError("score: --ospa-p must be at least 1");
    result.ospa_order = options.ospa_p;
  }
  if (options.match_distance) {
    result.match_distance = positive(options.match_distance, 0.0, "--match-distance");
  }
  return result;
}

ScoreResult score_files(const ScoreOptions& options) {
  const bool boxes =
      options.format == "mot" || (options.format == "auto" && looks_like_mot_file(options.truth));
  if (options.format != "auto" && options.format != "csv" && options.format != "mot") {
    throw UsageError(
        fmt::format("score: --format is '{}'; allowed are auto, csv and mot", options.format));
  }
  if (boxes) {
    return score(read_mot_file(options.truth, MotKind::kTruth),
                 read_mot_file(options.tracks, MotKind::kResult), settings(options, true));
  }
  return score(read_truth_csv(options.truth), read_tracks_csv(options.tracks),
               settings(options, false));
}

}  // namespace

int score(const ScoreOptions& options, const Manners&) {
  const ScoreResult result = score_files(options);
  if (!options.per_step.empty()) write_file(options.per_step, per_step_csv(result));
  print(options.json ? to_json(result).dump() + "\n" : to_text(result));
  return 0;
}

}  // namespace ghtrack::cli

// `ghtrack score`: the metrics alone.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/data_source.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/score_files.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/metrics/kitti_benchmark.hpp"
#include "tools/metrics/match_writer.hpp"
#include "tools/metrics/mot_benchmark.hpp"
#include "tools/metrics/point_scoring.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/kitti_file.hpp"

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

/// What a run says of itself beside its truth.csv; nothing of another file.
nlohmann::json metrics_of_run(const std::filesystem::path& truth) {
  if (truth.filename() != "truth.csv") return nlohmann::json::object();
  std::ifstream metrics(truth.parent_path() / "metrics.json");
  if (!metrics) return nlohmann::json::object();
  const auto json = nlohmann::json::parse(metrics, nullptr, /*allow_exceptions=*/false);
  return json.is_object() ? json : nlohmann::json::object();
}

/// What a run was scored with, as the metrics.json beside its truth.csv has it, so that both say
/// the same of the same files.
void take_parameters_of_run(const std::string& truth, ghtrack::ScoreOptions& result) {
  const nlohmann::json json = metrics_of_run(truth);
  if (!json.contains("parameters")) return;
  const auto& parameters = json["parameters"];
  const auto take = [&](const char* name, double fallback) {
    const auto found = parameters.find(name);
    return found != parameters.end() && found->is_number() ? found->get<double>() : fallback;
  };
  result.gospa.cutoff = take("gospa_c", result.gospa.cutoff);
  result.gospa.order = take("gospa_p", result.gospa.order);
  result.gospa.alpha = take("gospa_alpha", result.gospa.alpha);
  result.match_distance = take("match_distance", result.gospa.cutoff);
}

ghtrack::ScoreOptions settings(const ScoreOptions& options, const ScorePair& pair, bool boxes) {
  ghtrack::ScoreOptions result;
  if (boxes) result.gospa.cutoff = kBoxCutoff;
  take_parameters_of_run(pair.truth, result);
  if (options.gospa_c) result.match_distance.reset();
  result.gospa.cutoff = positive(options.gospa_c, result.gospa.cutoff, "--gospa-c");
  result.gospa.order = positive(options.gospa_p, result.gospa.order, "--gospa-p");
  result.gospa.alpha = positive(options.gospa_alpha, result.gospa.alpha, "--gospa-alpha");
  if (result.gospa.order < 1.0) throw UsageError("score: --gospa-p must be at least 1");
  if (result.gospa.alpha > 2.0) throw UsageError("score: --gospa-alpha must be at most 2");
  if (options.gospa_switching) {
    result.switching_penalty = positive(options.gospa_switching, 0.0, "--gospa-switching");
  }
  if (options.tgospa_gamma) {
    result.trajectory_penalty = positive(options.tgospa_gamma, 0.0, "--tgospa-gamma");
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

/// Files that are written as the instants go by, if they were asked for.
class Extras {
 public:
  Extras(const ScoreOptions& options, bool several) : several_(several) {
    if (!options.per_step.empty()) {
      steps_.emplace(options.per_step);
      steps_->write((several ? "sequence," : "") + step_csv_header());
    }
    if (!options.matches.empty()) matches_.emplace(options.matches, several);
  }

  void add(const std::string& sequence, const Scorer::Step& step, const ScoredSet& truth,
           const ScoredSet& tracks) {
    if (steps_) {
      CsvRow name;
      if (several_) name << sequence;
      steps_->write(name.text() + (several_ ? "," : "") + step_csv_row(step.score));
    }
    if (matches_) matches_->add(sequence, step.score.time, step.matches, truth, tracks);
  }

  /// Adds the steps of one sequence of boxes.
  OnBoxStep of(const std::string& sequence) {
    return [this, sequence](const Scorer::Step& step, const ScoredSet& truth,
                            const ScoredSet& tracks) {
      stop_if_interrupted();
      add(sequence, step, truth, tracks);
    };
  }

  void commit() {
    if (steps_) steps_->commit();
    if (matches_) matches_->commit();
  }

 private:
  bool several_;
  std::optional<AtomicFile> steps_;
  std::optional<MatchWriter> matches_;
};

ScoreResult score_box_files(const ScoreOptions& options, const ScorePair& pair, Extras& extras,
                            const Manners& manners) {
  if (options.latency) throw UsageError("score: --latency is for points, not for boxes");
  MotReader truth(pair.truth, MotKind::kTruth, std::nullopt, stop_if_interrupted);
  MotReader tracks(pair.tracks, MotKind::kResult, std::nullopt, stop_if_interrupted);
  const bool automatic = options.benchmark == "auto";
  const auto named = automatic
                         ? std::optional(recognise_benchmark(pair.truth, truth.has_categories()))
                         : benchmark_named(options.benchmark);
  if (!named) {
    throw UsageError(fmt::format(
        "score: --benchmark is '{}'; allowed are auto, MOT15, MOT16, MOT17, MOT20, none and, for "
        "labels of KITTI, KITTI-car and KITTI-pedestrian",
        shown(options.benchmark)));
  }
  if (automatic && !manners.quiet) {
    tell("ghtrack: {}: scored under the rules of {}", pair.truth, to_string(*named));
  }
  tell_if_sorted(pair.truth, truth.in_order(), manners);
  tell_if_sorted(pair.tracks, tracks.in_order(), manners);
  return score_boxes(
      *named, pair.truth, [&] { return truth.next(); }, [&] { return tracks.next(); },
      settings(options, pair, true), extras.of(pair.name));
}

/// Says which instants had no counterpart, and what became of them.
void tell_of_instants(const InstantCounts& counts, double truth_period, double track_period,
                      const Manners& manners) {
  if (manners.quiet) return;
  const auto tell_how_many = [](std::int64_t count, const std::string& whose,
                                const std::string& what) {
    if (count > 0) tell("ghtrack: {} instants of the {} {}", count, whose, what);
  };
  tell_how_many(
      counts.truth_unscored, "truth",
      fmt::format("are not scored: they lie between those of the tracks, which are {:.4g} s apart",
                  track_period));
  tell_how_many(
      counts.tracks_unscored, "tracks",
      fmt::format("are not scored: they lie between those of the truth, which are {:.4g} s apart",
                  truth_period));
  tell_how_many(counts.truth_alone, "truth", "have no tracks; they are scored as missed");
  tell_how_many(counts.tracks_alone, "tracks", "have no truth; they are scored as false");
}

/// Whether tracks and truth are of one run whose scans have all come in order: then each of them is
/// an instant of both, also where there are no tracks.
bool are_of_one_run(const ScorePair& pair) {
  const std::filesystem::path truth = pair.truth, tracks = pair.tracks;
  std::error_code ignored;
  if (tracks.filename() != "tracks.csv" ||
      !std::filesystem::equivalent(std::filesystem::absolute(truth, ignored).parent_path(),
                                   std::filesystem::absolute(tracks, ignored).parent_path(),
                                   ignored)) {
    return false;
  }
  const nlohmann::json metrics = metrics_of_run(truth);
  const nlohmann::json::json_pointer where("/arrivals/scans");
  if (!metrics.contains(where)) return false;
  const nlohmann::json& scans = metrics.at(where);
  const auto is_in_order = [](const nlohmann::json& sensor) {
    return sensor.is_object() && sensor.value("replayed", nlohmann::json()) == 0 &&
           sensor.value("refused", nlohmann::json()) == 0;
  };
  return scans.is_object() && std::all_of(scans.begin(), scans.end(), is_in_order);
}

ScoreResult score_point_files(const ScoreOptions& options, const ScorePair& pair, Extras& extras,
                              const Manners& manners) {
  const ReadOptions reading = read_options(options.data);
  PointReader tracks(pair.tracks, PointKind::kTracks, reading);
  PointReader truth(pair.truth, PointKind::kTruth, reading, tracks.origin());
  if (truth.origin() && !tracks.origin()) {
    throw InputError(
        fmt::format("{}: error: the truth is in degrees, the tracks are in metres "
                    "around an origin that their columns origin_lat and origin_lon do "
                    "not tell",
                    pair.tracks));
  }
  if (tracks.are_degrees() && !truth.origin()) {
    throw InputError(
        fmt::format("{}: error: the tracks are in degrees, the truth is in metres around an origin "
                    "that its columns origin_lat and origin_lon do not tell",
                    pair.truth));
  }
  tell_what_was_read(truth.understood(), truth.left_out(), truth.remarks(), manners);
  tell_what_was_read(tracks.understood(), tracks.left_out(), tracks.remarks(), manners);
  AtClock sources{.truth = {[&] { return truth.next(); }, truth.period()},
                  .tracks = {[&] { return tracks.next(); }, tracks.period()}};
  if (are_of_one_run(pair)) sources.tracks.period = 0.0;
  if (options.latency) {
    sources = at_clock(std::move(sources.truth), std::move(sources.tracks), *options.latency);
  }
  const ScoreResult result = score_points(
      sources.truth, sources.tracks, settings(options, pair, false),
      [&](const Scorer::Step& step, const ScoredSet& objects, const ScoredSet& estimates) {
        stop_if_interrupted();
        extras.add(pair.name, step, objects, estimates);
      });
  tell_of_instants(result.instants, truth.period(), tracks.period(), manners);
  return result;
}

bool are_boxes(const ScoreOptions& options, const ScorePair& pair) {
  return options.format == "mot" || options.format == "kitti" ||
         (options.format == "auto" && options.data.columns.empty() &&
          looks_like_mot_file(pair.truth));
}

/// What gets scores of its own.
struct Part {
  std::string name;
  std::function<ScoreResult(Extras&)> score;
};

/// The parts of a sequence with labels of KITTI: one of each kind that it has, or that was asked
/// for.
void add_labels(const ScoreOptions& options, const ScorePair& pair, std::vector<Part>& parts,
                const Manners& manners) {
  const auto truth =
      std::make_shared<KittiReader>(pair.truth, MotKind::kTruth, stop_if_interrupted);
  const auto tracks =
      std::make_shared<KittiReader>(pair.tracks, MotKind::kResult, stop_if_interrupted);
  tell_if_sorted(pair.truth, truth->in_order(), manners);
  tell_if_sorted(pair.tracks, tracks->in_order(), manners);
  std::string kinds;
  for (const KittiClass kind : kKittiClasses) {
    const bool automatic = options.benchmark == "auto";
    if (automatic ? !has_class(truth->types(), kind) && !has_class(tracks->types(), kind)
                  : kind != kitti_class_named(options.benchmark)) {
      continue;
    }
    const std::string name = fmt::format("{}, {}", pair.name, to_string(kind));
    kinds += fmt::format("{}{}", kinds.empty() ? "" : " and ", to_string(kind));
    parts.push_back({name, [=, &options](Extras& extras) {
                       truth->rewind();
                       tracks->rewind();
                       return score_labels(
                           kind, [&] { return truth->next(); }, [&] { return tracks->next(); },
                           settings(options, pair, true), extras.of(name));
                     }});
  }
  if (kinds.empty()) {
    throw InputError(fmt::format(
        "{}: error: KITTI scores cars and pedestrians, and there are none; --benchmark none scores "
        "every type",
        pair.truth));
  }
  if (!manners.quiet) {
    tell("ghtrack: {}: scored under the rules of KITTI for each {}", pair.truth, kinds);
  }
}

std::vector<Part> parts_of(const ScoreOptions& options, const std::vector<ScorePair>& pairs,
                           const Manners& manners) {
  std::vector<Part> parts;
  for (const ScorePair& pair : pairs) {
    const bool boxes = are_boxes(options, pair);
    const bool by_kind =
        options.benchmark == "auto" || kitti_class_named(options.benchmark).has_value();
    if (boxes && by_kind && looks_like_kitti_file(pair.truth)) {
      add_labels(options, pair, parts, manners);
      continue;
    }
    parts.push_back({pair.name, [&options, &manners, pair, boxes](Extras& extras) {
                       return boxes ? score_box_files(options, pair, extras, manners)
                                    : score_point_files(options, pair, extras, manners);
                     }});
  }
  return parts;
}

}  // namespace

int score(const ScoreOptions& options, const Manners& manners) {
  if (options.format != "auto" && options.format != "csv" && options.format != "mot" &&
      options.format != "kitti") {
    throw UsageError(fmt::format("score: --format is '{}'; allowed are auto, csv, mot and kitti",
                                 options.format));
  }
  const std::vector<Part> parts = parts_of(options, pairs_to_score(options), manners);
  const bool several = parts.size() > 1;
  Extras extras(options, several);
  std::vector<ScoreResult> results;
  for (const Part& part : parts) results.push_back(part.score(extras));
  extras.commit();
  const ScoreResult total = several ? combine(results) : results.front();
  if (!total.trajectories && !manners.quiet) {
    tell(
        "ghtrack: T-GOSPA is left out: its linear programme is too large to be solved in passing; "
        "--tgospa-gamma asks for it");
  }
  if (options.json) {
    nlohmann::ordered_json json = to_json(total);
    for (std::size_t i = 0; several && i < parts.size(); ++i) {
      json["sequences"][parts[i].name] = to_json(results[i]);
    }
    print(json.dump() + "\n");
    return 0;
  }
  for (std::size_t i = 0; several && i < parts.size(); ++i) {
    print(fmt::format("{}\n{}\n", printable(parts[i].name), to_text(results[i])));
  }
  print((several ? "combined\n" : "") + to_text(total));
  return 0;
}

}  // namespace ghtrack::cli

#include "tools/metrics/score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tools/metrics/mot_json.hpp"
#include "tools/metrics/switches.hpp"
#include "tools/metrics/text_table.hpp"
#include "tools/record/csv_writer.hpp"

namespace ghtrack {
namespace {

constexpr double kSameTime = 1e-9;

double time_of(const IdentifiedPoint& point) { return point.time; }
double time_of(const MotRow& row) { return row.frame; }

/// What is there at one instant.
struct Members {
  std::vector<std::int64_t> ids;
  std::vector<Eigen::Vector2d> positions;
  std::vector<Box> boxes;

  void clear() {
    ids.clear();
    positions.clear();
    boxes.clear();
  }
  void add(const IdentifiedPoint& point) {
    ids.push_back(point.id);
    positions.push_back(point.position);
  }
  void add(const MotRow& row) {
    ids.push_back(row.id);
    boxes.push_back({row.left, row.top, row.width, row.height});
    positions.push_back(boxes.back().centre());
  }
};

/// Moves the rows up to `time` from the front of `rows` into `members`.
template <class Row>
void take(std::span<const Row>& rows, double time, Members& members) {
  members.clear();
  std::size_t count = 0;
  while (count < rows.size() && time_of(rows[count]) <= time) members.add(rows[count++]);
  rows = rows.subspan(count);
}

void add_identities(MotScore& mot, const Members& truth, const Members& tracks, bool boxes,
                    double match_distance) {
  if (boxes) {
    mot.add_boxes(truth.ids, truth.boxes, tracks.ids, tracks.boxes);
  } else {
    mot.add_points(truth.ids, truth.positions, tracks.ids, tracks.positions, match_distance);
  }
}

/// Fills in the means over the steps.
void average(ScoreResult& result) {
  if (result.steps.empty()) return;
  for (const ScoreStep& step : result.steps) {
    result.gospa += step.gospa;
    result.gospa_localisation += step.gospa_localisation;
    result.gospa_missed += step.gospa_missed;
    result.gospa_false += step.gospa_false;
    result.ospa += step.ospa;
    result.switches += step.switches;
  }
  for (double* sum : {&result.gospa, &result.gospa_localisation, &result.gospa_missed,
                      &result.gospa_false, &result.ospa}) {
    *sum /= static_cast<double>(result.steps.size());
  }
  if (!result.options.switching_penalty) return;
  double sum = 0.0;
  for (const ScoreStep& step : result.steps) {
    sum += gospa_with_switches(step.gospa, step.switches, *result.options.switching_penalty,
                               result.options.gospa.order);
  }
  result.gospa_switching = sum / static_cast<double>(result.steps.size());
}

template <class Row>
ScoreResult score_rows(std::span<const Row> truth_rows, std::span<const Row> track_rows, bool boxes,
                       const ScoreOptions& options) {
  ScoreResult result;
  result.options = options;
  result.boxes = boxes;
  MotScore mot({options.gospa.cutoff, options.gospa.order});
  SwitchCounter switches;
  Members truth, tracks;
  double squared_error = 0.0;
  std::int64_t pairs = 0;
  while (!truth_rows.empty() || !track_rows.empty()) {
    double time = std::numeric_limits<double>::infinity();
    if (!truth_rows.empty()) time = std::min(time, time_of(truth_rows.front()));
    if (!track_rows.empty()) time = std::min(time, time_of(track_rows.front()));
    const double end = time + kSameTime * std::max(1.0, std::abs(time));
    take(truth_rows, end, truth);
    take(track_rows, end, tracks);

    const GospaResult sets = gospa(truth.positions, tracks.positions, options.gospa);
    for (const PointMatch& match : sets.matches) squared_error += match.distance * match.distance;
    pairs += std::ssize(sets.matches);
    result.steps.push_back(
        {time, static_cast<int>(truth.ids.size()), static_cast<int>(tracks.ids.size()), sets.gospa,
         sets.localisation, sets.missed, sets.false_tracks, sets.missed_count, sets.false_count,
         ospa(truth.positions, tracks.positions, options.gospa.cutoff, options.order_of_ospa()),
         switches.add(truth.ids, tracks.ids, sets.matches)});
    add_identities(mot, truth, tracks, boxes, options.matching());
  }
  average(result);
  if (pairs > 0) result.rmse = std::sqrt(squared_error / static_cast<double>(pairs));
  result.mot = mot.result();
  return result;
}

}  // namespace

ScoreResult score(std::span<const IdentifiedPoint> truth, std::span<const IdentifiedPoint> tracks,
                  const ScoreOptions& options) {
  return score_rows(truth, tracks, false, options);
}

ScoreResult score(std::span<const MotRow> truth, std::span<const MotRow> tracks,
                  const ScoreOptions& options) {
  return score_rows(truth, tracks, true, options);
}

nlohmann::ordered_json to_json(const ScoreResult& result) {
  nlohmann::ordered_json json;
  json["gospa"] = result.gospa;
  json["gospa_localisation"] = result.gospa_localisation;
  json["gospa_missed"] = result.gospa_missed;
  json["gospa_false"] = result.gospa_false;
  json["ospa"] = result.ospa;
  json["gospa_switching"] =
      result.gospa_switching ? nlohmann::ordered_json(*result.gospa_switching) : nullptr;
  json["switches"] = result.switches;
  json["rmse"] = result.rmse ? nlohmann::ordered_json(*result.rmse) : nullptr;
  add_mot(json, result.mot);
  json["steps"] = result.steps.size();
  auto& parameters = json["parameters"];
  parameters["gospa_c"] = result.options.gospa.cutoff;
  parameters["gospa_p"] = result.options.gospa.order;
  parameters["gospa_alpha"] = result.options.gospa.alpha;
  const double ospa_order = result.options.order_of_ospa();
  parameters["ospa_p"] = std::isfinite(ospa_order) ? nlohmann::ordered_json(ospa_order)
                                                   : nlohmann::ordered_json("inf");
  if (result.options.switching_penalty) {
    parameters["gospa_switching"] = *result.options.switching_penalty;
  }
  if (result.boxes) {
    parameters["match_iou"] = 0.5;
  } else {
    parameters["match_distance"] = result.options.matching();
  }
  return json;
}

std::string to_text(const ScoreResult& result) {
  std::vector<std::vector<std::string>> rows;
  const nlohmann::ordered_json json = to_json(result);
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) continue;
    rows.push_back({key, value.is_number_float() ? fmt::format("{:.4f}", value.get<double>())
                         : value.is_null()       ? "-"
                                                 : value.dump()});
  }
  return text_table({{"score", 24}, {"value", 16, true}}, rows);
}

std::string per_step_csv(const ScoreResult& result) {
  CsvRow rows;
  for (const ScoreStep& step : result.steps) {
    rows << step.time << step.truths << step.tracks << step.gospa << step.gospa_localisation
         << step.gospa_missed << step.gospa_false << step.missed << step.false_tracks << step.ospa
         << step.switches;
    rows.end();
  }
  return "t,truths,tracks,gospa,gospa_localisation,gospa_missed,gospa_false,missed,false,ospa,"
         "switches\n" +
         rows.text();
}

}  // namespace ghtrack

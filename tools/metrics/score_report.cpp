// The scores as JSON, as text and as rows of CSV.

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/metrics/json_values.hpp"
#include "tools/metrics/mot_json.hpp"
#include "tools/metrics/score.hpp"
#include "tools/metrics/text_table.hpp"
#include "tools/record/csv_writer.hpp"

namespace ghtrack {
namespace {

using json::number;
using Json = nlohmann::ordered_json;

Json parameters_of(const ScoreResult& result) {
  Json parameters;
  parameters["gospa_c"] = result.options.gospa.cutoff;
  parameters["gospa_p"] = result.options.gospa.order;
  parameters["gospa_alpha"] = result.options.gospa.alpha;
  const double ospa_order = result.options.order_of_ospa();
  parameters["ospa_p"] = std::isfinite(ospa_order) ? Json(ospa_order) : Json("inf");
  if (result.options.switching_penalty) {
    parameters["gospa_switching"] = *result.options.switching_penalty;
  }
  parameters["tgospa_gamma"] = result.options.penalty_of_trajectories();
  if (result.boxes) {
    parameters["match_iou"] = 0.5;
    parameters["benchmark"] = result.benchmark.empty() ? "none" : result.benchmark;
  } else {
    parameters["match_distance"] = result.options.matching();
  }
  return parameters;
}

}  // namespace

Json to_json(const ScoreResult& result) {
  Json json;
  json["gospa"] = result.gospa;
  json["gospa_localisation"] = result.gospa_localisation;
  json["gospa_missed"] = result.gospa_missed;
  json["gospa_false"] = result.gospa_false;
  json["ospa"] = result.ospa;
  json["gospa_switching"] = number(result.gospa_switching);
  json["switches"] = result.switches;
  const auto part = [&](double TrajectoryGospaResult::*member) {
    return result.trajectories ? Json((*result.trajectories).*member) : Json();
  };
  json["tgospa"] = part(&TrajectoryGospaResult::tgospa);
  json["tgospa_localisation"] = part(&TrajectoryGospaResult::localisation);
  json["tgospa_missed"] = part(&TrajectoryGospaResult::missed);
  json["tgospa_false"] = part(&TrajectoryGospaResult::false_tracks);
  json["tgospa_switch"] = part(&TrajectoryGospaResult::switches);
  json["rmse"] = number(result.rmse);
  add_mot(json, result.mot);
  json["steps"] = result.steps;
  json["instants"] = {{"matched", result.instants.matched},
                      {"truth_without_tracks", result.instants.truth_alone},
                      {"tracks_without_truth", result.instants.tracks_alone},
                      {"truth_not_scored", result.instants.truth_unscored},
                      {"tracks_not_scored", result.instants.tracks_unscored}};
  json["parameters"] = parameters_of(result);
  return json;
}

std::string to_text(const ScoreResult& result) {
  std::vector<std::vector<std::string>> rows;
  const Json json = to_json(result);
  std::string parameters;
  for (const auto& [key, value] : json.at("parameters").items()) {
    parameters += fmt::format("{}{} {}", parameters.empty() ? "" : ", ", key,
                              value.is_string() ? value.get<std::string>() : value.dump());
  }
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) continue;
    rows.push_back({key, value.is_number_float() ? fmt::format("{:.4f}", value.get<double>())
                         : value.is_null()       ? "-"
                                                 : value.dump()});
  }
  return text_table({{"score", 24}, {"value", 16, true}}, rows) + "with " + parameters + "\n";
}

std::string step_csv_header() {
  return "t,truths,tracks,gospa,gospa_localisation,gospa_missed,gospa_false,missed,false,ospa,"
         "switches\n";
}

std::string step_csv_row(const ScoreStep& step) {
  CsvRow row;
  row << step.time << step.truths << step.tracks << step.gospa << step.gospa_localisation
      << step.gospa_missed << step.gospa_false << step.missed << step.false_tracks << step.ospa
      << step.switches;
  row.end();
  return row.text();
}

}  // namespace ghtrack

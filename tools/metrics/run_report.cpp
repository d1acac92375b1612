#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/metrics/json_values.hpp"
#include "tools/metrics/mot_json.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/metrics/text_table.hpp"

namespace ghtrack {
namespace {

using json::interval;
using json::number;
using Json = nlohmann::ordered_json;

/// What sixteen shadows say of one run may be no more than a guess: then it is left out.
ObjectReport as_far_as_known(ObjectReport object) {
  constexpr double kWidest = 0.25;  // half an interval, beside its middle
  const auto is_guess = [](const std::optional<Interval>& range) {
    return range && range->high - range->low > kWidest * (range->high + range->low);
  };
  if (is_guess(object.predicted_velocity_ci95)) {
    object.predicted_velocity.reset();
    object.predicted_velocity_ci95.reset();
  }
  if (!is_guess(object.predicted_rmse_ci95)) return object;
  object.predicted_rmse_ci95.reset();
  for (auto* value : {&object.predicted_rmse, &object.predicted_lag, &object.predicted_mai,
                      &object.predicted_nis}) {
    value->reset();
  }
  return object;
}

Json object_json(const ObjectReport& as_computed) {
  const ObjectReport object = as_far_as_known(as_computed);
  Json json;
  json["id"] = object.id;
  json["name"] = object.name;
  json["regime"] = object.regime;
  json["filter"] = object.filter;
  json["gains"] = object.gains;
  json["scans"] = object.scans;
  json["tracked"] = object.tracked;
  json["detections"] = object.detections;
  json["detections_used"] = object.detections_used;
  json["detections_missed"] = object.detections_missed;
  json["track_changes"] = object.track_changes;
  json["track_losses"] = object.track_losses;
  json["rmse"] = number(object.rmse_position);
  json["rmse_ci95"] = interval(object.rmse_position_ci95);
  json["predicted"] = number(object.predicted_rmse);
  json["predicted_ci95"] = interval(object.predicted_rmse_ci95);
  json["rmse_at_clock"] = number(object.rmse_at_clock);
  json["raw"] = number(object.measurement_rmse);
  json["best_fixed_gains"] = number(object.best_fixed_gains);
  json["crlb"] = number(object.crlb);
  json["smoother"] = number(object.smoother);
  json["rmse_velocity"] = number(object.rmse_velocity);
  json["predicted_velocity"] = number(object.predicted_velocity);
  json["predicted_velocity_ci95"] = interval(object.predicted_velocity_ci95);
  json["bias"] = object.bias ? Json::array({number(object.bias->x()), number(object.bias->y())})
                             : Json(nullptr);
  json["peak_error"] = number(object.peak_error);
  json["lag"] = number(object.lag);
  json["predicted_lag"] = number(object.predicted_lag);
  json["settling_time"] = number(object.settling_time);
  json["mai"] = number(object.mai);
  json["predicted_mai"] = number(object.predicted_mai);
  json["nees"] = number(object.nees);
  json["nees_bounds95"] = interval(object.nees_bounds95);
  json["nis"] = number(object.nis);
  json["predicted_nis"] = number(object.predicted_nis);
  json["nis_bounds95"] = interval(object.nis_bounds95);
  return json;
}

Json counts_json(const RunCounts& counts) {
  Json json;
  for (const RunCounts::Sensor& sensor : counts.sensors) {
    json["scans"][sensor.name] = {{"in_order", sensor.scans.in_order},
                                  {"replayed", sensor.scans.replayed},
                                  {"refused", sensor.scans.refused}};
  }
  json["detections_refused"] = counts.detections_refused;
  return json;
}

/// A line for every sensor whose scans came late, and one for what could not be used.
std::string counts_text(const RunCounts& counts) {
  std::string text;
  for (const auto& [name, scans] : counts.sensors) {
    if (scans.replayed + scans.refused == 0) continue;
    text += fmt::format("{}: {} scans in order, {} replayed, {} refused.\n", name, scans.in_order,
                        scans.replayed, scans.refused);
  }
  if (counts.detections_refused > 0) {
    text += fmt::format("{} detections refused.\n", counts.detections_refused);
  }
  return text;
}

Json total_json(const TotalReport& total) {
  Json json;
  json["scans"] = total.scans;
  json["rmse"] = number(total.rmse_of_pairs);
  json["rmse_followed"] = number(total.rmse_position);
  json["predicted"] = number(total.predicted_rmse);
  json["rmse_velocity"] = number(total.rmse_velocity);
  json["raw"] = number(total.measurement_rmse);
  json["mai"] = number(total.mai);
  json["gospa"] = number(total.gospa);
  json["gospa_localisation"] = number(total.gospa_localisation);
  json["gospa_missed"] = number(total.gospa_missed);
  json["gospa_false"] = number(total.gospa_false);
  json["switches"] = total.switches;
  json["ospa"] = number(total.ospa);
  json["missed_targets"] = number(total.missed_targets);
  json["false_tracks"] = number(total.false_tracks);
  add_mot(json, total.mot);
  return json;
}

std::string cell(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return "-";
  return std::abs(*value) < 1e5 ? fmt::format("{:.3f}", *value) : fmt::format("{:.2e}", *value);
}

Json json_without_objects(const RunReport& report) {
  const GospaOptions gospa = report.options.gospa();
  Json json;
  json["parameters"] = {{"gospa_c", gospa.cutoff},
                        {"gospa_p", gospa.order},
                        {"gospa_alpha", gospa.alpha},
                        {"match_distance", report.options.matching()}};
  json["total"] = total_json(report.total);
  json["arrivals"] = counts_json(report.counts);
  return json;
}

/// The lines of a text behind the first moved to the right.
std::string indented(std::string_view text, std::size_t columns) {
  std::string moved;
  for (const char c : text) {
    moved += c;
    if (c == '\n') moved.append(columns, ' ');
  }
  return moved;
}

}  // namespace

Json to_json(const RunReport& report) {
  Json json = json_without_objects(report);
  json["objects"] = Json::array();
  for (const ObjectReport& object : report.objects) json["objects"].push_back(object_json(object));
  return json;
}

void write_json(const RunReport& report, const std::function<void(std::string_view)>& write) {
  std::string text = json_without_objects(report).dump(2);
  text.resize(text.rfind("\n}"));
  write(text + ",\n  \"objects\": [");
  std::string_view separator = "\n    ";
  for (const ObjectReport& object : report.objects) {
    write(separator);
    write(indented(object_json(object).dump(2), 4));
    separator = ",\n    ";
  }
  write(report.objects.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

std::string to_table(const RunReport& report, std::size_t width) {
  const bool has_bound =
      std::any_of(report.objects.begin(), report.objects.end(),
                  [](const ObjectReport& object) { return object.crlb.has_value(); });
  const bool has_latency =
      std::any_of(report.objects.begin(), report.objects.end(),
                  [](const ObjectReport& object) { return object.rmse_at_clock.has_value(); });
  std::vector<TextColumn> columns = {
      {"object", 17}, {"regime", 8}, {"filter and gains", 26}, {"RMSE [m]", 8, true}};
  if (has_latency) columns.push_back({"at clock", 8, true});
  columns.push_back({"predicted", 14, true});
  for (const char* heading : {"raw", "best fixed"}) columns.push_back({heading, 10, true});
  if (has_bound) columns.push_back({"CRLB", 8, true});
  for (const char* heading : {"smoother", "MAI [m]"}) columns.push_back({heading, 8, true});
  columns.push_back({"used/missed", 12, true});
  std::vector<std::vector<std::string>> rows;
  for (const ObjectReport& as_computed : report.objects) {
    const ObjectReport object = as_far_as_known(as_computed);
    std::vector<std::string>& row = rows.emplace_back();
    row = {object.name, object.regime,
           object.gains.empty() ? object.filter : object.filter + " " + object.gains};
    row.push_back(cell(object.rmse_position));
    if (has_latency) row.push_back(cell(object.rmse_at_clock));
    row.push_back(cell(object.predicted_rmse));
    if (const auto& range = object.predicted_rmse_ci95) {
      row.back() += fmt::format(" ±{:.1g}", 0.5 * (range->high - range->low));
    }
    for (const auto& rmse : {object.measurement_rmse, object.best_fixed_gains}) {
      row.push_back(cell(rmse));
    }
    if (has_bound) row.push_back(cell(object.crlb));
    for (const auto& length : {object.smoother, object.mai}) row.push_back(cell(length));
    row.push_back(fmt::format("{}/{}", object.detections_used, object.detections_missed));
  }
  const TotalReport& total = report.total;
  const ClearMotResult& clear = total.mot.clear;
  const GospaOptions gospa = report.options.gospa();
  return text_table(columns, rows, {.width = width}) +
         "predicted: by theory; best fixed: expected of the best fixed gains in hindsight;\n"
         "smoother: knows later detections, too; raw: of the detections; MAI: mean absolute\n"
         "innovation; " +
         std::string(has_latency ? "at clock: of what was known then;\n" : "") +
         std::string(has_bound ? "CRLB: no filter is expected to do better;\n" : "") +
         "used/missed: scans with and without a detection used\n" +
         fmt::format(
             "\nGOSPA {} m (c {:.4g} m, p {:.4g}, alpha {:.4g}): {:.3g} missed and {:.3g} false "
             "per "
             "scan. OSPA {} m.\n"
             "MOTA {:.3f}, IDF1 {:.3f}, HOTA {:.3f}; {} ID switches, {} fragmentations.\n",
             cell(total.gospa), gospa.cutoff, gospa.order, gospa.alpha, total.missed_targets,
             total.false_tracks, cell(total.ospa), clear.mota, total.mot.identity.idf1,
             total.mot.hota.hota, clear.id_switches, clear.fragmentations) +
         counts_text(report.counts);
}

}  // namespace ghtrack

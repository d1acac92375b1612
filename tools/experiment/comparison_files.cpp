// A comparison as CSV, as JSON and as a table for a terminal.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tools/experiment/comparison.hpp"
#include "tools/metrics/json_values.hpp"
#include "tools/metrics/text_table.hpp"
#include "tools/record/csv_writer.hpp"

namespace ghtrack {
namespace {

using json::interval;
using json::number;
using Json = nlohmann::ordered_json;

std::optional<double> low(const std::optional<Interval>& interval) {
  if (!interval) return std::nullopt;
  return interval->low;
}
std::optional<double> high(const std::optional<Interval>& interval) {
  if (!interval) return std::nullopt;
  return interval->high;
}

Json row_json(const ComparisonRow& row, const Comparison& comparison) {
  const ComparedCell& cell = comparison.cells[row.cell];
  Json json = {{"scene", cell.scene},
               {"sweep", cell.sweep},
               {"regime", row.regime},
               {"object", row.object},
               {"filter", comparison.filters[row.filter]},
               {"gains", row.gains},
               {"metric", info(row.metric).name},
               {"unit", info(row.metric).unit},
               {"mean", number(row.mean)},
               {"ci95", interval(row.ci95)},
               {"interval", interval_kind(info(row.metric).average)},
               {"predicted", number(row.predicted)},
               {"predicted_ci95", interval(row.predicted_ci95)}};
  for (const Reference& reference : kReferences) {
    json[std::string(reference.name)] = number(row.hindsight.*reference.value);
  }
  json.update({{"runs", row.runs},
               {"difference", number(row.difference)},
               {"difference_ci95", interval(row.difference_ci95)},
               {"verdict", to_string(row.significance)},
               {"runs_to_decide", number(row.runs_to_decide)},
               {"median", number(row.median)},
               {"median_ci95", interval(row.median_ci95)},
               {"heavy_tails", row.has_heavy_tails},
               {"tracking_index", number(row.tracking_index)}});
  return json;
}

Json curve_json(const ErrorCurve& curve, const Comparison& comparison) {
  Json points = Json::array();
  for (const ErrorCurve::Point& point : curve.points) {
    points.push_back(
        {number(point.time), number(point.rmse), number(point.band.low), number(point.band.high)});
  }
  return {{"filter", comparison.filters[curve.filter]},
          {"regime", curve.regime},
          {"columns", {"t", "rmse_position", "low5", "high95"}},
          {"points", std::move(points)}};
}

Json cell_json(const ComparedCell& cell, const Comparison& comparison) {
  Json curves = Json::array();
  for (const ErrorCurve& curve : cell.curves) curves.push_back(curve_json(curve, comparison));
  return {{"scene", cell.scene},        {"file", cell.file},     {"sweep", cell.sweep},
          {"runs", cell.runs},          {"seed", cell.seed},     {"duration", cell.duration},
          {"sigma", cell.sigma},        {"period", cell.period}, {"regimes", cell.regimes},
          {"curves", std::move(curves)}};
}

std::string title_of(const ComparedCell& cell) {
  return cell.sweep.empty() ? cell.scene : cell.scene + ", " + cell.sweep;
}

/// "0.123 ±0.004 *": what one filter did, as the words above the table say.
std::string cell_text(const ComparisonRow& row) {
  std::string text = fmt::format("{:.3g}", row.typical());
  if (row.has_heavy_tails) text += "~";
  if (const auto& interval = row.typical_ci95()) {
    text += fmt::format(" ±{:.1g}", 0.5 * (interval->high - interval->low));
  }
  switch (row.significance) {
    case Significance::kNone:
    case Significance::kWorse:
      return text;
    case Significance::kTooFew:
      return text + " few";
    case Significance::kBest:
      return text + " *";
    case Significance::kTied:
      return text + " =";
    case Significance::kUndecided:
      return text + " ?";
  }
  return text;
}

/// "12": the percentage of its scans in which an object was not followed, from 1 on.
std::string lost_text(const ComparisonRow& tracked) {
  const double lost = 100.0 * (1.0 - tracked.mean);
  return lost < 1.0 ? "" : fmt::format("{:.2g}", lost);
}

/// How many runs would decide all that is undecided; nothing if all is decided.
std::optional<double> runs_to_decide(const Comparison& comparison) {
  std::optional<double> most;
  for (const ComparisonRow& row : comparison.rows) {
    if (row.metric != Metric::kRmsePosition || row.regime.empty() || !row.object.empty()) continue;
    if (row.runs_to_decide) most = std::max(most.value_or(0.0), *row.runs_to_decide);
  }
  return most;
}

/// The row of a table: a regime as a whole in one cell.
using TableKey = std::tuple<std::size_t, std::string>;
using TableRows = std::map<TableKey, std::map<std::size_t, const ComparisonRow*>>;

std::string lost_text_of(const TableRows& tracked, const TableKey& key, std::size_t filter) {
  const auto line = tracked.find(key);
  if (line == tracked.end() || !line->second.contains(filter)) return "";
  return lost_text(*line->second.at(filter));
}

}  // namespace

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "scene,regime,object,filter,gains,metric,mean,ci95_low,ci95_high,predicted,runs,sweep,unit,"
      "interval,raw,best_fixed_gains,crlb,smoother,difference,difference_low,difference_high,"
      "verdict,runs_to_decide,median,median_low,median_high,tails,tracking_index,predicted_low,"
      "predicted_high\n";
  CsvRow line;
  for (const ComparisonRow& row : comparison.rows) {
    const ComparedCell& cell = comparison.cells[row.cell];
    line.clear();
    line << cell.scene << row.regime << row.object << comparison.filters[row.filter] << row.gains
         << info(row.metric).name << row.mean << low(row.ci95) << high(row.ci95) << row.predicted
         << row.runs << cell.sweep << info(row.metric).unit
         << interval_kind(info(row.metric).average) << row.hindsight.raw
         << row.hindsight.best_fixed_gains << row.hindsight.crlb << row.hindsight.smoother
         << row.difference << low(row.difference_ci95) << high(row.difference_ci95)
         << to_string(row.significance) << row.runs_to_decide << row.median << low(row.median_ci95)
         << high(row.median_ci95) << (row.has_heavy_tails ? "heavy" : "") << row.tracking_index
         << low(row.predicted_ci95) << high(row.predicted_ci95);
    line.end();
    text += line.text();
  }
  return text;
}

nlohmann::ordered_json to_json(const Comparison& comparison) {
  Json cells = Json::array();
  for (const ComparedCell& cell : comparison.cells) cells.push_back(cell_json(cell, comparison));
  Json rows = Json::array();
  for (const ComparisonRow& row : comparison.rows) rows.push_back(row_json(row, comparison));
  return {{"filters", comparison.filters}, {"cells", std::move(cells)}, {"rows", std::move(rows)}};
}

std::string to_table(const Comparison& comparison, std::size_t width) {
  TableRows lines, tracked;
  for (const ComparisonRow& row : comparison.rows) {
    if (row.regime.empty() || !row.object.empty()) continue;
    if (row.metric == Metric::kRmsePosition) lines[{row.cell, row.regime}][row.filter] = &row;
    if (row.metric == Metric::kTracked) tracked[{row.cell, row.regime}][row.filter] = &row;
  }
  const auto loses = [&](std::size_t filter) {
    return std::any_of(tracked.begin(), tracked.end(), [&](const auto& line) {
      const auto found = line.second.find(filter);
      return found != line.second.end() && !lost_text(*found->second).empty();
    });
  };
  std::vector<TextColumn> columns = {{"scene", 44, false}, {"regime", 12, false}};
  for (std::size_t i = 0; i < comparison.filters.size(); ++i) {
    columns.push_back({printable(comparison.filters[i], 20), 20, true});
    if (!loses(i)) continue;
    columns.push_back({.title = "lost %", .most = 6, .right_aligned = true, .continues = true});
  }
  std::vector<Reference> references;  // that are known of any line
  for (const Reference& reference : kReferences) {
    const bool is_known = std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
      return (line.second.begin()->second->hindsight.*reference.value).has_value();
    });
    if (!is_known) continue;
    references.push_back(reference);
    columns.push_back({std::string(reference.title), 10, true});
  }
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, filters] : lines) {
    std::vector<std::string>& line = table.emplace_back();
    line = {title_of(comparison.cells[std::get<0>(key)]), std::get<1>(key)};
    for (std::size_t i = 0; i < comparison.filters.size(); ++i) {
      line.push_back(filters.contains(i) ? cell_text(*filters.at(i)) : "");
      if (loses(i)) line.push_back(lost_text_of(tracked, key, i));
    }
    const Hindsight& hindsight = filters.begin()->second->hindsight;
    for (const Reference& reference : references) {
      const std::optional<double>& rmse = hindsight.*reference.value;
      line.push_back(rmse ? fmt::format("{:.3g}", *rmse) : "");
    }
  }
  std::string text =
      "RMSE of position [m] ± half of its 95 % interval. * better than all others, = within 1 % "
      "of\n"
      "the best, ? undecided, few: too few runs to tell; ~ the median of the runs, where few may "
      "make\n"
      "most of the mean. lost %: scans in which an object was not followed, which no RMSE counts.\n"
      "raw: the detections; best fixed: expected of the best fixed gains, chosen afterwards, "
      "knowing\n"
      "which detection is whose; CRLB: below which no filter can be, where the motion is random by "
      "a\n"
      "law that is known; smoother: of one that also knows all later detections\n\n" +
      text_table(columns, table, {.width = width, .repeated = 2});
  if (const auto runs = runs_to_decide(comparison)) {
    text += fmt::format("About {:.0f} runs would decide what is undecided.\n", *runs);
  }
  return text;
}

}  // namespace ghtrack

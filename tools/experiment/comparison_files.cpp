// A comparison as CSV, as JSON and as a table for a terminal.

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tools/experiment/comparison.hpp"
#include "tools/metrics/text_table.hpp"
#include "tools/record/csv_writer.hpp"

namespace ghtrack {
namespace {

using Json = nlohmann::ordered_json;

std::optional<double> low(const std::optional<Interval>& interval) {
  if (!interval) return std::nullopt;
  return interval->low;
}
std::optional<double> high(const std::optional<Interval>& interval) {
  if (!interval) return std::nullopt;
  return interval->high;
}

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}
Json range(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return Json::array({number(interval->low), number(interval->high)});
}

std::string_view interval_kind(Metric metric) {
  return info(metric).averaging.skewed ? "bootstrap" : "t";
}

Json row_json(const ComparisonRow& row, const Comparison& comparison) {
  const ComparedCell& cell = comparison.cells[row.cell];
  return {{"scene", cell.scene},
          {"sweep", cell.sweep},
          {"regime", row.regime},
          {"object", row.object},
          {"filter", comparison.filters[row.filter]},
          {"gains", row.gains},
          {"metric", info(row.metric).name},
          {"unit", info(row.metric).unit},
          {"mean", number(row.mean)},
          {"ci95", range(row.ci95)},
          {"interval", interval_kind(row.metric)},
          {"predicted", number(row.predicted)},
          {"bound", number(row.bound)},
          {"runs", row.runs},
          {"difference", number(row.difference)},
          {"difference_ci95", range(row.difference_ci95)},
          {"verdict", to_string(row.significance)}};
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

/// "0.123 ±0.004", and a star for a winner.
std::string cell_text(const ComparisonRow& row) {
  std::string text = fmt::format("{:.3g}", row.mean);
  if (row.ci95) text += fmt::format(" ±{:.1g}", 0.5 * (row.ci95->high - row.ci95->low));
  if (row.significance == Significance::kBest) text += " *";
  if (row.significance == Significance::kTied) text += " =";
  return text;
}

/// The row of a table: a regime as a whole in one cell.
using TableKey = std::tuple<std::size_t, std::string>;

}  // namespace

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "scene,regime,object,filter,gains,metric,mean,ci95_low,ci95_high,predicted,runs,sweep,unit,"
      "interval,bound,difference,difference_low,difference_high,verdict\n";
  CsvRow line;
  for (const ComparisonRow& row : comparison.rows) {
    const ComparedCell& cell = comparison.cells[row.cell];
    line.clear();
    line << cell.scene << row.regime << row.object << comparison.filters[row.filter] << row.gains
         << info(row.metric).name << row.mean << low(row.ci95) << high(row.ci95) << row.predicted
         << row.runs << cell.sweep << info(row.metric).unit << interval_kind(row.metric)
         << row.bound << row.difference << low(row.difference_ci95) << high(row.difference_ci95)
         << to_string(row.significance);
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
  std::map<TableKey, std::map<std::size_t, const ComparisonRow*>> lines;
  for (const ComparisonRow& row : comparison.rows) {
    if (row.metric != Metric::kRmsePosition || row.regime.empty() || !row.object.empty()) continue;
    lines[{row.cell, row.regime}][row.filter] = &row;
  }
  std::vector<TextColumn> columns = {{"scene", 44, false}, {"regime", 12, false}};
  for (const std::string& filter : comparison.filters) {
    columns.push_back({printable(filter, 20), 20, true});
  }
  columns.push_back({"bound", 12, true});
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, filters] : lines) {
    std::vector<std::string>& line = table.emplace_back();
    line = {title_of(comparison.cells[std::get<0>(key)]), std::get<1>(key)};
    for (std::size_t i = 0; i < comparison.filters.size(); ++i) {
      line.push_back(filters.contains(i) ? cell_text(*filters.at(i)) : "");
    }
    const std::optional<double>& bound = filters.begin()->second->bound;
    line.push_back(bound ? fmt::format("{:.3g}", *bound) : "");
  }
  return "RMSE of position [m] ± half of its 95 % interval; * better than all others, = tied\n"
         "with the best; bound: least error of a filter that knows which detection is whose\n\n" +
         text_table(columns, table, {.width = width, .repeated = 2});
}

}  // namespace ghtrack

#include "tools/report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "tools/report/figures.hpp"
#include "tools/report/headings.hpp"

namespace ghtrack::report {
namespace {

using Json = nlohmann::json;
using RowsByFilter = std::map<std::size_t, const ComparisonRow*>;

constexpr std::size_t kMostObjects = 60;

std::string number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.3g}", *value) : "";
}

Json sort_key(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(fmt::format("{:.6g}", *value)) : Json("");
}

bool leads(Significance significance) {
  return significance == Significance::kBest || significance == Significance::kTied;
}

std::string_view css_of(Significance significance) {
  return leads(significance) ? to_string(significance) : "";
}

/// "0.318 ± 0.004, best; predicted 0.31": what one filter did. Where few runs make most of the
/// mean, their median.
Json value_cell(const ComparisonRow* row) {
  if (row == nullptr) {
    return {{"text", ""}, {"half", ""}, {"verdict", ""},
            {"css", ""},  {"sort", ""}, {"predicted", ""}};
  }
  const auto& interval = row->typical_ci95();
  const bool is_worse = row->significance == Significance::kWorse;  // as most are
  const std::string half =
      interval ? fmt::format("±{:.1g}", 0.5 * (interval->high - interval->low)) : "";
  return {{"text", number(row->typical()) + (row->has_heavy_tails ? "~" : "")},
          {"half", half},
          {"verdict", is_worse ? "" : to_string(row->significance)},
          {"css", css_of(row->significance)},
          {"sort", sort_key(row->typical())},
          {"predicted", number(row->predicted)}};
}

Json value_cells(const std::vector<std::size_t>& filters, const RowsByFilter& rows) {
  Json values = Json::array();
  for (const std::size_t filter : filters) {
    values.push_back(value_cell(rows.contains(filter) ? rows.at(filter) : nullptr));
  }
  return values;
}

/// What the errors may be held against, as far as it is known of anything.
std::vector<Reference> references_in(const Comparison& comparison) {
  std::vector<Reference> known;
  for (const Reference& reference : kReferences) {
    if (std::any_of(comparison.rows.begin(), comparison.rows.end(), [&](const ComparisonRow& row) {
          return (row.hindsight.*reference.value).has_value();
        }))
      known.push_back(reference);
  }
  return known;
}

Json reference_cells(const std::vector<Reference>& references, const RowsByFilter& rows) {
  const Hindsight& hindsight = rows.begin()->second->hindsight;
  Json cells = Json::array();
  for (const Reference& reference : references) {
    const std::optional<double>& rmse = hindsight.*reference.value;
    cells.push_back({{"text", number(rmse)}, {"sort", sort_key(rmse)}});
  }
  return cells;
}

Json named(const Comparison& comparison, const std::vector<std::size_t>& filters) {
  Json names = Json::array();
  for (const std::size_t filter : filters) {
    names.push_back({{"name", comparison.filters[filter]}, {"css", filter_class(filter)}});
  }
  return names;
}

std::vector<std::size_t> filters_in(const Comparison& comparison, std::size_t cell) {
  std::set<std::size_t> filters;
  for (const ComparisonRow& row : comparison.rows) {
    if (row.cell == cell) filters.insert(row.filter);
  }
  return {filters.begin(), filters.end()};
}

std::string with_unit(const MetricInfo& metric) {
  return std::string(metric.title) + (metric.unit == "1" ? "" : ", " + std::string(metric.unit));
}

/// The mean, and in how many runs there was a value where it was not in all.
std::string mean_text(const ComparisonRow& row, std::int64_t all) {
  return number(row.mean) + (row.runs == all ? "" : fmt::format(" ({} runs)", row.runs));
}

}  // namespace

std::string cell_id(std::size_t cell) { return fmt::format("scene-{}", cell + 1); }

nlohmann::json reference_names(const Comparison& comparison) {
  Json names = Json::array();
  for (const Reference& reference : references_in(comparison))
    names.push_back({{"title", reference.title}});
  return names;
}

nlohmann::json filters_of(const Comparison& comparison, std::size_t cell) {
  return named(comparison, filters_in(comparison, cell));
}

nlohmann::json summary_tables(const Comparison& comparison) {
  const std::vector<Reference> references = references_in(comparison);
  std::map<std::pair<std::size_t, std::string>, RowsByFilter> lines;
  for (const ComparisonRow& row : comparison.rows) {
    if (row.metric != Metric::kRmsePosition || row.regime.empty() || !row.object.empty()) continue;
    lines[{row.cell, row.regime}][row.filter] = &row;
  }
  std::map<std::vector<std::size_t>, Json> tables;
  for (std::size_t i = 0; i < comparison.cells.size(); ++i) {
    const ComparedCell& cell = comparison.cells[i];
    const std::vector<std::size_t> filters = filters_in(comparison, i);
    for (const std::string& regime : cell.regimes) {
      const auto line = lines.find({i, regime});
      if (line == lines.end()) continue;
      Json& rows = tables[filters];
      rows.push_back({{"scene", cell.scene},
                      {"sweep", in_words(cell.sweep)},
                      {"href", "#" + cell_id(i)},
                      {"regime", regime},
                      {"values", value_cells(filters, line->second)},
                      {"references", reference_cells(references, line->second)}});
    }
  }
  Json all = Json::array();
  for (auto& [filters, rows] : tables) {
    all.push_back({{"filters", named(comparison, filters)}, {"rows", std::move(rows)}});
  }
  return all;
}

nlohmann::json metric_rows(const Comparison& comparison, std::size_t cell) {
  Json rows = Json::array();
  for (const ComparisonRow& row : comparison.rows) {
    if (row.cell != cell || !row.object.empty()) continue;
    const MetricInfo& metric = info(row.metric);
    std::string difference = number(row.difference);
    if (row.difference_ci95) difference += fmt::format(" ({})", range_text(row.difference_ci95));
    rows.push_back({{"subject", row.regime.empty() ? "whole scene" : row.regime},
                    {"metric", with_unit(metric)},
                    {"filter", comparison.filters[row.filter]},
                    {"mean", mean_text(row, comparison.cells[cell].runs)},
                    {"ci95", range_text(row.ci95)},
                    {"predicted", number(row.predicted)},
                    {"difference", difference},
                    {"verdict", to_string(row.significance)},
                    {"css", css_of(row.significance)}});
  }
  return rows;
}

nlohmann::json object_table(const Comparison& comparison, std::size_t cell) {
  std::vector<std::pair<std::pair<std::string, std::string>, RowsByFilter>> lines;
  for (const ComparisonRow& row : comparison.rows) {
    if (row.cell != cell || row.object.empty() || row.metric != Metric::kRmsePosition) continue;
    const std::pair subject(row.regime, row.object);
    if (lines.empty() || lines.back().first != subject) lines.push_back({subject, {}});
    lines.back().second[row.filter] = &row;
  }
  const std::vector<std::size_t> filters = filters_in(comparison, cell);
  const std::vector<Reference> references = references_in(comparison);
  Json rows = Json::array();
  for (const auto& [subject, by_filter] : lines) {
    if (rows.size() == kMostObjects) break;
    rows.push_back({{"object", subject.second},
                    {"regime", subject.first},
                    {"values", value_cells(filters, by_filter)},
                    {"references", reference_cells(references, by_filter)}});
  }
  const std::size_t left_out = lines.size() - rows.size();
  return {{"filters", named(comparison, filters)},
          {"rows", std::move(rows)},
          {"left_out", left_out == 0 ? Json(nullptr) : Json(left_out)}};
}

}  // namespace ghtrack::report

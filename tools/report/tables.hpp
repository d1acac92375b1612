#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/experiment/comparison.hpp"

// The tables of a comparison as values for the page's template. Numbers are texts of three digits;
// `sort` has them in full for sorting.

namespace ghtrack::report {

/// [{filters: [{name, css}], rows: [{scene, sweep, href, regime, values, references}]}]: RMSE of
/// position, regime by filter; cells that compare the same filters share a table.
nlohmann::json summary_tables(const Comparison& comparison);

/// [{subject, metric, filter, mean, ci95, predicted, references, difference, verdict, css,
/// runs}]: all metrics of the regimes of a cell, and of the scene as a whole.
nlohmann::json metric_rows(const Comparison& comparison, std::size_t cell);

/// {filters, rows: [{object, regime, values, references}], left_out}: RMSE of position of the
/// objects.
nlohmann::json object_table(const Comparison& comparison, std::size_t cell);

/// [{title}] of `references`, which are [{text, sort}]: what errors may be held against.
nlohmann::json reference_names(const Comparison& comparison);

/// [{name, css}] of the filters that the cell has rows of.
nlohmann::json filters_of(const Comparison& comparison, std::size_t cell);

/// "scene-1"
std::string cell_id(std::size_t cell);

}  // namespace ghtrack::report

#include "tools/plot/series_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "tools/data/table.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack::plot {
namespace {

/// The columns of one filter's rows, by name.
using Columns = std::map<std::string, std::vector<double>>;

struct FilteredSeries {
  std::vector<std::string> filters;  // in the order of the file; one without a name if it has none
  std::map<std::string, Columns> rows;
};

FilteredSeries read_series(const std::string& path) {
  Table table(path);
  FilteredSeries series;
  const auto filter = table.column("filter");
  while (table.next()) {
    const std::string name = filter ? std::string(table.cell(*filter)) : std::string();
    if (!series.rows.contains(name)) series.filters.push_back(name);
    Columns& columns = series.rows[name];
    for (std::size_t i = 0; i < table.headings().size(); ++i) {
      if (i != filter) {
        columns[table.headings()[i].text].push_back(table.number(i).value_or(kNothing));
      }
    }
  }
  table.throw_findings();
  if (series.filters.empty()) throw InputError(path + ": error: the series has no rows");
  return series;
}

const std::vector<double>* column(const FilteredSeries& series, const std::string& filter,
                                  const std::string& name) {
  const Columns& columns = series.rows.at(filter);
  const auto found = columns.find(name);
  return found == columns.end() ? nullptr : &found->second;
}

Panel panel_of(const FilteredSeries& series, const SeriesLabels& labels, const std::string& title,
               const std::string& y_label, const std::string& name, Mark mark) {
  Panel panel{.title = title, .x_label = labels.time, .y_label = y_label};
  int colour = 0;
  for (const std::string& filter : series.filters) {
    const auto* const values = column(series, filter, name);
    if (values == nullptr) continue;
    panel.curves.push_back({.name = "",
                            .x = *column(series, filter, "t"),
                            .y = *values,
                            .mark = mark,
                            .colour = colour++});
  }
  return panel;
}

/// Interrupts a curve where it passes from one end of a ring to the other.
void interrupt_at_seam(Curve& curve, double ring) {
  Curve whole = std::move(curve);
  curve = {.name = whole.name, .x = {}, .y = {}, .mark = whole.mark, .colour = whole.colour};
  for (std::size_t i = 0; i < whole.y.size(); ++i) {
    if (i > 0 && std::abs(whole.y[i] - whole.y[i - 1]) > 0.5 * ring) {
      curve.x.push_back(whole.x[i]);
      curve.y.push_back(kNothing);
    }
    curve.x.push_back(whole.x[i]);
    curve.y.push_back(whole.y[i]);
  }
}

void add_bounds(Panel& panel) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Curve& curve : panel.curves) {
    for (const double value : curve.y) {
      if (!std::isfinite(value)) continue;
      sum += value * value;
      ++count;
    }
  }
  if (count == 0) return;
  const double rms = std::sqrt(sum / static_cast<double>(count));
  const std::string whose = panel.curves.size() > 1 ? " of all" : "";
  panel.levels = {{2.0 * rms, "+ 2 rms" + whose}, {-2.0 * rms, "− 2 rms" + whose}};
}

/// The panels of one axis of a vector, or of a series that has no other.
/// @param axis  "x", "y" or "z"; empty if there is no other
void add_axis(const FilteredSeries& series, const SeriesLabels& labels, const std::string& axis,
              Figure& figure) {
  const std::string& first = series.filters.front();
  const std::string suffix = axis.empty() ? "" : "_" + axis;  // of its columns
  const auto title = [&](const std::string& what) {
    return axis.empty() ? what : fmt::format("{} in {}", what, axis);
  };
  const bool is_named = labels.value != SeriesLabels{}.value;
  const std::string quantity = axis.empty() ? labels.value
                               : is_named   ? fmt::format("{}, {}", labels.value, axis)
                                            : axis;
  Panel values = panel_of(series, labels, title("estimate"), quantity, "x" + suffix, Mark::kLine);
  values.wide = true;
  for (std::size_t i = 0; i < values.curves.size(); ++i) {  // the colours are those of all panels
    const auto called = labels.filters.find(series.filters[i]);
    values.curves[i].name = called == labels.filters.end() ? series.filters[i] : called->second;
  }
  const std::vector<double>& t = *column(series, first, "t");
  const auto* const z = column(series, first, "z" + suffix);
  if (z != nullptr && labels.shows_measurements) {
    values.curves.insert(values.curves.begin(),
                         {.name = "measured", .x = t, .y = *z, .mark = Mark::kDots, .colour = -2});
  }
  const auto* const truth = column(series, first, "truth" + suffix);
  if (truth != nullptr) {
    values.curves.push_back(
        {.name = "truth", .x = t, .y = *truth, .mark = Mark::kDashes, .colour = -1});
  }
  for (Curve& curve : values.curves) {
    if (labels.ring && curve.mark != Mark::kDots) interrupt_at_seam(curve, *labels.ring);
  }
  figure.panels.push_back(std::move(values));
  Panel residual =
      panel_of(series, labels, title("residual"), "z − prior", "residual" + suffix, Mark::kLine);
  add_bounds(residual);
  figure.panels.push_back(std::move(residual));
  if (truth != nullptr) {
    Panel error =
        panel_of(series, labels, title("error"), "estimate − truth", "x" + suffix, Mark::kLine);
    for (std::size_t i = 0; i < error.curves.size(); ++i) {
      const auto* const own = column(series, series.filters[i], "truth" + suffix);
      for (std::size_t k = 0; own != nullptr && k < error.curves[i].y.size(); ++k) {
        double& value = error.curves[i].y[k];
        value -= (*own)[k];
        if (labels.ring) value = std::remainder(value, *labels.ring);
      }
    }
    figure.panels.push_back(std::move(error));
  }
  Panel rate =
      panel_of(series, labels, title("rate"), fmt::format("d{}/dt", axis.empty() ? "x" : axis),
               "dx" + suffix, Mark::kLine);
  // Who estimates none says 0 throughout; places on a row have none.
  std::erase_if(rate.curves, [](const Curve& curve) {
    return std::none_of(curve.y.begin(), curve.y.end(),
                        [](double value) { return value != 0.0 && std::isfinite(value); });
  });
  if (!rate.curves.empty()) figure.panels.push_back(std::move(rate));
}

}  // namespace

bool is_series_file(const std::string& path) {
  const Table table(path);
  return table.column("t") && (table.column("x_pred") || table.column("x_pred_x")) &&
         !table.column("track_id");
}

Figure figure_of_series(const std::string& path, const SeriesLabels& labels) {
  const FilteredSeries series = read_series(path);
  Figure figure{.title = labels.title, .panels = {}};
  const Columns& columns = series.rows.at(series.filters.front());
  if (columns.contains("x")) {
    add_axis(series, labels, "", figure);
  } else {
    for (const std::string axis : {"x", "y", "z"}) {
      if (columns.contains("x_" + axis)) add_axis(series, labels, axis, figure);
    }
  }
  return figure;
}

}  // namespace ghtrack::plot

#include "tools/report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "tools/report/chart.hpp"
#include "tools/report/headings.hpp"

namespace ghtrack::report {
namespace {

constexpr std::size_t kColours = 7;

/// The least and the largest of the finite values added.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void add_positive(double value) {
    if (value > 0.0) add(value);
  }
  bool is_empty() const { return !(low <= high); }
  double size() const { return high - low; }
  double middle() const { return 0.5 * (low + high); }
  void grow_to(double least_size) {
    if (size() >= least_size) return;
    const double centre = middle();
    low = centre - 0.5 * least_size;
    high = centre + 0.5 * least_size;
  }
};

std::vector<ChartPoint> chart_points(const std::vector<ExampleRun::Point>& points) {
  std::vector<ChartPoint> out;
  for (const ExampleRun::Point& point : points) out.push_back({point.x, point.y});
  return out;
}

/// Draws lines as exactly as that many points allow.
void draw_lines(Chart& chart, const std::vector<std::vector<ChartPoint>>& lines,
                std::size_t most_points, std::string_view css) {
  constexpr double kFinest = 1.0;
  constexpr double kCoarsest = 64.0;
  std::vector<std::vector<ChartPoint>> simple;
  for (double tolerance = kFinest; tolerance <= kCoarsest; tolerance *= 1.5) {
    simple.clear();
    std::size_t points = 0;
    for (const std::vector<ChartPoint>& line : lines) {
      points += simple.emplace_back(chart.simplified(line, tolerance)).size();
    }
    if (points <= most_points) break;
  }
  for (const std::vector<ChartPoint>& line : simple) chart.line(line, css);
}

void draw_dots(Chart& chart, const std::vector<ExampleRun::Point>& points, std::size_t most_points,
               std::string_view css) {
  const std::size_t step = (points.size() + most_points - 1) / most_points;
  std::vector<ChartPoint> few;
  for (std::size_t i = 0; i < points.size(); i += step) few.push_back({points[i].x, points[i].y});
  chart.dots(few, css);
}

/// Metres are as long in x as in y, unless the world is so flat that nothing would be seen.
struct WorldView {
  Range x, y;
  int height = Chart::kHeight;
};

/// Curves are shown whole, unless a filter has lost its way: then as far as half of the world
/// beyond.
void add_estimates(const ExampleRun& example, WorldView& view) {
  constexpr double kBeyond = 0.5;
  const WorldView world = view;
  const double reach = kBeyond * std::max(world.x.size(), world.y.size());
  for (const ExampleRun::Estimate& estimate : example.estimates) {
    for (const auto& track : estimate.tracks) {
      for (const ExampleRun::Point& point : track) {
        view.x.add(std::clamp(point.x, world.x.low - reach, world.x.high + reach));
        view.y.add(std::clamp(point.y, world.y.low - reach, world.y.high + reach));
      }
    }
  }
}

WorldView view_of(const ExampleRun& example) {
  constexpr int kLowest = 320;
  constexpr int kTallest = 660;
  constexpr double kFlattest = 0.04;
  WorldView view;
  for (const ExampleRun::Path& path : example.truth) {
    for (const ExampleRun::Point& point : path.points) {
      view.x.add(point.x);
      view.y.add(point.y);
    }
  }
  for (const ExampleRun::Point& point : example.detections) {
    view.x.add(point.x);
    view.y.add(point.y);
  }
  if (view.x.is_empty() || view.y.is_empty()) return view;
  add_estimates(example, view);
  const double margin = 0.04 * std::max({view.x.size(), view.y.size(), 1e-6});
  const bool flat = view.y.size() < kFlattest * view.x.size();
  view.x.grow_to(view.x.size() + 2.0 * margin);
  view.y.grow_to(flat ? std::max(1.2 * view.y.size(), 1e-6) : view.y.size() + 2.0 * margin);
  const double wanted = Chart::kWidth * view.y.size() / view.x.size();
  view.height = std::clamp(flat ? kLowest : static_cast<int>(wanted), kLowest, kTallest);
  if (flat) return view;
  view.y.grow_to(view.x.size() * view.height / Chart::kWidth);
  view.x.grow_to(view.y.size() * Chart::kWidth / view.height);
  return view;
}

const ErrorCurve* curve_of(const ComparedCell& cell, const std::string& regime,
                           std::size_t filter) {
  for (const ErrorCurve& curve : cell.curves) {
    if (curve.regime == regime && curve.filter == filter) return &curve;
  }
  return nullptr;
}

/// Curves of a regime in the order of the filters.
std::vector<const ErrorCurve*> curves_of(const Comparison& comparison, const ComparedCell& cell,
                                         const std::string& regime) {
  std::vector<const ErrorCurve*> curves;
  for (std::size_t filter = 0; filter < comparison.filters.size(); ++filter) {
    const ErrorCurve* curve = curve_of(cell, regime, filter);
    if (curve != nullptr && !curve->points.empty()) curves.push_back(curve);
  }
  return curves;
}

double short_number(double value) { return std::stod(fmt::format("{:.3g}", value)); }

/// Where grid values change into each other; the outermost are as far out as in.
std::vector<double> edges(const std::vector<double>& values, bool geometric) {
  const auto forward = [&](double value) { return geometric ? std::log(value) : value; };
  const auto back = [&](double value) { return geometric ? std::exp(value) : value; };
  const std::size_t n = values.size();
  std::vector<double> out{back(1.5 * forward(values[0]) - 0.5 * forward(values[1]))};
  for (std::size_t i = 1; i < n; ++i) {
    out.push_back(back(0.5 * (forward(values[i - 1]) + forward(values[i]))));
  }
  out.push_back(back(1.5 * forward(values[n - 1]) - 0.5 * forward(values[n - 2])));
  return out;
}

/// Nothing where gains are unstable.
std::optional<int> shade_of(double rmse, double least) {
  if (!(rmse > 0.0) || !std::isfinite(rmse)) return std::nullopt;
  const double share = std::log(rmse / least) / std::log(kWorstShown);
  return std::clamp(static_cast<int>(share * kShades), 0, kShades - 1);
}

}  // namespace

std::string filter_class(std::size_t filter) {
  return fmt::format("s{}{}", filter % kColours + 1, filter < kColours ? "" : " again");
}

std::optional<std::string> overlay_figure(const ComparedCell& cell, std::size_t most_points) {
  const ExampleRun& example = cell.example;
  const WorldView view = view_of(example);
  if (view.x.is_empty() || view.y.is_empty()) return std::nullopt;
  const int rows = std::max(4, view.height / 70);
  Chart chart("Truth, detections and estimates in " + cell.scene,
              linear_axis("x [m]", view.x.low, view.x.high, 7),
              linear_axis("y [m]", view.y.low, view.y.high, rows), view.height);
  draw_dots(chart, example.clutter, most_points, "clutter");
  draw_dots(chart, example.detections, most_points, "detection");
  for (const ExampleRun::Estimate& estimate : example.estimates) {
    std::vector<std::vector<ChartPoint>> tracks;
    for (const auto& track : estimate.tracks) tracks.push_back(chart_points(track));
    draw_lines(chart, tracks, most_points, filter_class(estimate.filter));
  }
  std::vector<std::vector<ChartPoint>> paths;
  for (const ExampleRun::Path& path : example.truth) paths.push_back(chart_points(path.points));
  draw_lines(chart, paths, most_points, "truth");
  return chart.svg();
}

std::optional<std::string> error_figure(const Comparison& comparison, const ComparedCell& cell,
                                        const std::string& regime) {
  constexpr double kDecade = 10.0;
  constexpr std::size_t kBandStep = 2;  // the static band is for the eye; scripts get every point
  const std::vector<const ErrorCurve*> curves = curves_of(comparison, cell, regime);
  Range errors;
  for (const ErrorCurve* curve : curves) {
    for (const ErrorCurve::Point& point : curve->points) {
      errors.add_positive(point.rmse);
      errors.add_positive(point.band.low);
      errors.add_positive(point.band.high);
    }
  }
  if (errors.is_empty()) return std::nullopt;
  // A band from zero would stretch a logarithmic axis without end.
  const double high = 1.1 * errors.high;
  const double low = std::max(errors.low / 1.1, high / 1e4);
  Chart chart(fmt::format("Error over time of {} in {}", regime, cell.scene),
              linear_axis("time [s]", 0.0, cell.duration, 8),
              logarithmic_axis("RMSE [m]", std::min(low, high / kDecade), high));
  for (const ErrorCurve* curve : curves) {
    std::vector<ChartPoint> from;
    std::vector<ChartPoint> to;
    for (std::size_t i = 0; i < curve->points.size(); i += kBandStep) {
      const auto& [time, rmse, band] = curve->points[i];
      from.push_back({time, std::max(band.low, low)});
      to.push_back({time, band.high});
    }
    chart.band(from, to, filter_class(curve->filter));
  }
  for (const ErrorCurve* curve : curves) {
    std::vector<ChartPoint> line;
    for (const ErrorCurve::Point& point : curve->points) line.push_back({point.time, point.rmse});
    chart.line(line, filter_class(curve->filter));
  }
  return chart.svg();
}

nlohmann::json error_data(const Comparison& comparison, const ComparedCell& cell,
                          const std::string& regime) {
  const std::vector<const ErrorCurve*> curves = curves_of(comparison, cell, regime);
  std::map<double, std::map<std::size_t, nlohmann::json>> by_time;
  nlohmann::json data = {{"labels", nlohmann::json::array()},
                         {"colours", nlohmann::json::array()},
                         {"rows", nlohmann::json::array()}};
  for (const ErrorCurve* curve : curves) {
    data["labels"].push_back(comparison.filters[curve->filter]);
    data["colours"].push_back(curve->filter % kColours + 1);
    for (const ErrorCurve::Point& point : curve->points) {
      by_time[point.time][curve->filter] = {short_number(point.band.low), short_number(point.rmse),
                                            short_number(point.band.high)};
    }
  }
  for (auto& [time, values] : by_time) {
    nlohmann::json row = {short_number(time)};
    for (const ErrorCurve* curve : curves) row.push_back(values[curve->filter]);
    data["rows"].push_back(std::move(row));
  }
  return data;
}

std::optional<std::string> prediction_figure(const Comparison& comparison) {
  Range range;
  std::vector<const ComparisonRow*> rows;
  for (const ComparisonRow& row : comparison.rows) {
    const bool of_regime = !row.regime.empty() && row.object.empty();
    if (row.metric != Metric::kRmsePosition || !of_regime || !row.predicted) continue;
    if (!(row.mean > 0.0 && *row.predicted > 0.0)) continue;
    range.add(row.mean);
    range.add(*row.predicted);
    rows.push_back(&row);
  }
  if (range.is_empty()) return std::nullopt;
  const double low = range.low / 1.3;
  const double high = range.high * 1.3;
  Chart chart("Predicted against measured RMSE of position",
              logarithmic_axis("predicted RMSE [m]", low, high),
              logarithmic_axis("measured RMSE [m]", low, high), 620);
  const std::array<ChartPoint, 2> equal = {{{low, low}, {high, high}}};
  chart.line(equal, "truth");
  for (const ComparisonRow* row : rows) {
    const ComparedCell& cell = comparison.cells[row->cell];
    chart.mark({*row->predicted, row->mean}, filter_class(row->filter),
               fmt::format("{}{}{}, {}, {}: predicted {:.3g} m, measured {:.3g} m", cell.scene,
                           cell.sweep.empty() ? "" : ", ", in_words(cell.sweep), row->regime,
                           comparison.filters[row->filter], *row->predicted, row->mean));
  }
  return chart.svg();
}

double least_error(const GainSurface& surface) {
  Range errors;
  for (const double rmse : surface.rmse) errors.add_positive(rmse);
  return errors.is_empty() ? std::numeric_limits<double>::quiet_NaN() : errors.low;
}

std::optional<std::string> surface_figure(const std::vector<std::string>& filters,
                                          const GainSurface& surface) {
  const double least = least_error(surface);
  if (!std::isfinite(least) || surface.g.size() < 2 || surface.h.size() < 2) return std::nullopt;
  const std::vector<double> g = edges(surface.g, false);
  const std::vector<double> h = edges(surface.h, true);
  Chart chart("Expected error over g and h: " + surface.regime,
              linear_axis("g", std::max(0.0, g.front()), g.back(), 6),
              logarithmic_axis("h", h.front(), h.back()));
  for (std::size_t i = 0; i < surface.g.size(); ++i) {
    const std::span<const double> column(&surface.rmse[i * surface.h.size()], surface.h.size());
    for (std::size_t from = 0, to = 0; from < column.size(); from = to) {
      const std::optional<int> shade = shade_of(column[from], least);
      for (to = from + 1; to < column.size() && shade_of(column[to], least) == shade;) ++to;
      if (!shade) continue;
      chart.rectangle({g[i], h[to]}, {g[i + 1], h[from]}, fmt::format("shade{}", *shade));
    }
  }
  chart.star({surface.best.g, surface.best.h}, "best",
             fmt::format("the best: g {:.3g}, h {:.3g}, expected RMSE {:.3g} m", surface.best.g,
                         surface.best.h, least));
  for (const GainSurface::Mark& mark : surface.marks) {
    chart.mark(
        {mark.gains.g, mark.gains.h}, filter_class(mark.filter),
        fmt::format("{}: g {:.3g}, h {:.3g}", filters.at(mark.filter), mark.gains.g, mark.gains.h));
  }
  return chart.svg();
}

}  // namespace ghtrack::report

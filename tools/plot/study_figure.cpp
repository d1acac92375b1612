#include "tools/plot/study_figure.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "tools/record/errors.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack::plot {
namespace {

using Json = nlohmann::json;

Json read_json(const std::string& path) {
  std::ifstream file(path);
  return Json::parse(file, nullptr, /*allow_exceptions=*/false);
}

bool is_comparison(const Json& json) {
  return json.is_object() && json.contains("cells") && json.contains("rows") &&
         json.at("rows").is_array();
}

double number(const Json& row, const char* key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_number() ? found->get<double>() : kNothing;
}

std::string text(const Json& row, const char* key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_string() ? found->get<std::string>() : "";
}

/// The g of "gh g=0.5 h=0.2"; NaN if there is none.
double g_of(const std::string& gains) {
  const std::size_t at = gains.find("gh g=");
  return at == 0 ? std::strtod(gains.c_str() + 5, nullptr) : kNothing;
}

/// A regime in a cell.
struct Point {
  double index = kNothing;                                // λ
  double best = std::numeric_limits<double>::infinity();  // error ÷ raw of the best filter
  double fixed = kNothing;                                // of the best fixed gains
  double bound = kNothing;                                // of the posterior bound
  double g = kNothing;                                    // that was tuned for the g-h filter
};

/// By regime, in the order of the file; each by λ.
std::vector<std::pair<std::string, std::vector<Point>>> points_of(const Json& json) {
  const auto is_tuned = [](const Json& row) { return text(row, "filter").rfind("tuned ", 0) == 0; };
  const bool any_tuned = std::any_of(json.at("rows").begin(), json.at("rows").end(), is_tuned);
  std::vector<std::string> regimes;
  std::map<std::string, std::map<std::string, Point>> by_cell;
  for (const Json& row : json.at("rows")) {
    const std::string regime = text(row, "regime");
    if (text(row, "metric") != "rmse" || regime.empty() || !text(row, "object").empty()) continue;
    if (std::find(regimes.begin(), regimes.end(), regime) == regimes.end()) {
      regimes.push_back(regime);
    }
    Point& point = by_cell[regime][text(row, "scene") + " " + text(row, "sweep")];
    const double raw = number(row, "raw");
    point.index = number(row, "tracking_index");
    point.fixed = number(row, "best_fixed_gains") / raw;
    point.bound = number(row, "crlb") / raw;
    if (text(row, "filter") == "tuned g-h") point.g = g_of(text(row, "gains"));
    if (!any_tuned || is_tuned(row)) point.best = std::fmin(point.best, number(row, "mean") / raw);
  }
  std::vector<std::pair<std::string, std::vector<Point>>> all;
  for (const std::string& regime : regimes) {
    auto& [name, points] = all.emplace_back(regime, std::vector<Point>{});
    for (const auto& [cell, point] : by_cell[regime]) {
      if (point.index > 0.0) points.push_back(point);
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const Point& a, const Point& b) { return a.index < b.index; });
  }
  return all;
}

template <class Value>
Curve curve_of(const std::string& name, const std::vector<Point>& points, Mark mark, int colour,
               const Value& value) {
  Curve curve{.name = name, .x = {}, .y = {}, .mark = mark, .colour = colour};
  for (const Point& point : points) {
    curve.x.push_back(point.index);
    curve.y.push_back(value(point));
  }
  return curve;
}

/// What steady motion of Kalata's model gives, from the least to the greatest index.
template <class Value>
Curve theory(double low, double high, const Value& value) {
  constexpr int kPoints = 200;
  Curve curve{.name = "Kalata", .x = {}, .y = {}, .mark = Mark::kDashes, .colour = -1};
  for (int i = 0; i < kPoints; ++i) {
    const double index = low * std::pow(high / low, i / (kPoints - 1.0));
    curve.x.push_back(index);
    curve.y.push_back(value(tracking_index_gains(1, index).g));
  }
  return curve;
}

}  // namespace

bool is_comparison_file(const std::string& path) {
  return path.size() > 5 && path.rfind(".json") == path.size() - 5 &&
         is_comparison(read_json(path));
}

Figure figure_of_study(const std::string& path, const std::string& title) {
  const Json json = read_json(path);
  if (!is_comparison(json)) throw InputError(path + ": error: is no comparison.json");
  const auto regimes = points_of(json);
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const auto& [regime, points] : regimes) {
    for (const Point& point : points) {
      low = std::min(low, point.index);
      high = std::max(high, point.index);
    }
  }
  const std::string index = "tracking index λ = a T² / σ";
  Panel error{.title = "Error ÷ raw", .x_label = index, .y_label = "RMSE ÷ RMSE of the detections"};
  Panel gain{.title = "Tuned g", .x_label = index, .y_label = "g"};
  Panel cells{.title = "Where each regime's cells lie", .x_label = index, .y_label = ""};
  for (Panel* panel : {&error, &gain, &cells}) panel->x_logarithmic = true;
  error.y_logarithmic = true;
  cells.wide = true;
  if (low < high) {
    error.curves.push_back(theory(low, high, [](double g) { return std::sqrt(g); }));
    gain.curves.push_back(theory(low, high, [](double g) { return g; }));
  }
  int colour = 0;
  for (const auto& [regime, points] : regimes) {
    error.curves.push_back(curve_of(regime, points, Mark::kDots, colour,
                                    [](const Point& point) { return point.best; }));
    error.curves.push_back(
        curve_of("", points, Mark::kRings, colour, [](const Point& point) { return point.fixed; }));
    error.curves.push_back(
        curve_of("", points, Mark::kLine, colour, [](const Point& point) { return point.bound; }));
    gain.curves.push_back(
        curve_of(regime, points, Mark::kDots, colour, [](const Point& point) { return point.g; }));
    const double row = colour++;
    cells.curves.push_back(curve_of("", points, Mark::kDots, static_cast<int>(row),
                                    [row](const Point&) { return row; }));
    cells.y_names.push_back(regime);
  }
  error.levels.push_back({1.0, "the detections themselves"});
  Figure figure{.title = title, .panels = {error}};
  const bool any_gain = std::any_of(gain.curves.begin(), gain.curves.end(), [](const Curve& curve) {
    return curve.colour >= 0 &&
           std::any_of(curve.y.begin(), curve.y.end(), [](double g) { return std::isfinite(g); });
  });
  if (any_gain) figure.panels.push_back(gain);
  figure.panels.push_back(cells);
  return figure;
}

}  // namespace ghtrack::plot

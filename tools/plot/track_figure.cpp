#include "tools/plot/track_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "tools/data/clock.hpp"
#include "tools/metrics/point_scoring.hpp"
#include "tools/plot/track_table.hpp"

namespace ghtrack::plot {
namespace {

constexpr std::size_t kFew = 8;  // tracks that a legend or bands can show, each in its colour
constexpr double kUpper95 = 5.991464547;  // of χ² with 2 degrees of freedom
constexpr double kLongAgo = 1e6;          // times beyond are shown since the first [s]

/// Estimate minus truth of a track over time.
struct ErrorCurves {
  std::vector<double> t, x, y, sigma_x, sigma_y;
};

/// Everything that the panels draw.
struct Data {
  std::vector<TrackCurves> tracks, truth, detections;
  std::map<std::string, ErrorCurves> errors;  // by track
  bool boxes = false;
  double start = 0.0;  // what is subtracted from times [s]

  bool has(Quantity quantity) const {
    return std::any_of(tracks.begin(), tracks.end(), [&](const TrackCurves& track) {
      const auto& values = track.of(quantity);
      return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    });
  }
  std::string unit() const { return boxes ? "px" : "m"; }
  std::string time_label() const {
    if (boxes) return "frame";
    if (start == 0.0) return "t [s]";
    const std::string text = format_date_time(start);
    return fmt::format("t − {}Z [s]", text.substr(0, text.find('.')));
  }
  std::vector<double> shifted(const std::vector<double>& times) const {
    std::vector<double> result = times;
    for (double& time : result) time -= start;
    return result;
  }
};

/// Adds the errors of the tracks that GOSPA assigns to objects of the truth.
void add_errors(const TrackPlot& plot, Data& data) {
  PointReader tracks(plot.tracks, PointKind::kTracks);
  PointReader truth(plot.truth, PointKind::kTruth, {}, tracks.origin());
  std::map<std::string, const TrackCurves*> by_name;
  for (const TrackCurves& track : data.tracks) by_name[track.name] = &track;
  ScoreOptions options;
  if (plot.cutoff > 0.0) options.gospa.cutoff = plot.cutoff;
  const auto add = [&](const Scorer::Step& step, const ScoredSet& objects,
                       const ScoredSet& estimates) {
    for (const PointMatch& match : step.matches) {
      const auto track = static_cast<std::size_t>(match.track);
      const std::string name = tracks.name_of(estimates.ids[track]);
      const Eigen::Vector2d error =
          estimates.positions[track] - objects.positions[static_cast<std::size_t>(match.truth)];
      ErrorCurves& errors = data.errors[name];
      errors.t.push_back(step.score.time - data.start);
      errors.x.push_back(error.x());
      errors.y.push_back(error.y());
      const auto found = by_name.find(name);
      const auto sigma = [&](Quantity quantity) {
        if (found == by_name.end() || found->second->of(quantity).empty()) {
          return std::numeric_limits<double>::quiet_NaN();
        }
        return found->second->of(quantity)[found->second->nearest(step.score.time)];
      };
      errors.sigma_x.push_back(sigma(Quantity::kSigmaX));
      errors.sigma_y.push_back(sigma(Quantity::kSigmaY));
    }
  };
  score_points({[&] { return truth.next(); }, truth.period()},
               {[&] { return tracks.next(); }, tracks.period()}, options, add);
}

Data load(const TrackPlot& plot) {
  Data data;
  CurveFile tracks = read_curves(plot.tracks, {});
  data.tracks = std::move(tracks.curves);
  data.boxes = tracks.boxes;
  if (!plot.truth.empty()) data.truth = read_curves(plot.truth, {}, tracks.origin).curves;
  if (!plot.detections.empty()) {
    data.detections = read_curves(plot.detections, plot.reading, tracks.origin).curves;
  }
  double first = std::numeric_limits<double>::infinity();
  for (const TrackCurves& track : data.tracks) {
    if (!track.t.empty()) first = std::min(first, track.t.front());
  }
  if (std::isfinite(first) && std::abs(first) > kLongAgo) data.start = std::floor(first);
  if (!plot.truth.empty() && !data.boxes) add_errors(plot, data);
  return data;
}

/// The curves of detections, truth and tracks over time or along the path.
using Pick = std::function<const std::vector<double>&(const TrackCurves&)>;

Panel positions(const Data& data, const std::string& title, const std::string& y_label,
                const Pick& y, bool along_path) {
  Panel panel{.title = title,
              .x_label = along_path ? fmt::format("x [{}]", data.unit()) : data.time_label(),
              .y_label = y_label};
  const auto x_of = [&](const TrackCurves& curves) {
    return along_path ? curves.x : data.shifted(curves.t);
  };
  Curve seen{
      .name = along_path ? "detections" : "", .x = {}, .y = {}, .mark = Mark::kDots, .colour = -2};
  for (const TrackCurves& curves : data.detections) {
    const std::vector<double> x = x_of(curves);
    seen.x.insert(seen.x.end(), x.begin(), x.end());
    seen.y.insert(seen.y.end(), y(curves).begin(), y(curves).end());
  }
  if (!seen.x.empty()) panel.curves.push_back(std::move(seen));
  const auto add_truth = [&] {
    for (std::size_t i = 0; i < data.truth.size(); ++i) {
      panel.curves.push_back({.name = along_path && i == 0 ? "truth" : "",
                              .x = x_of(data.truth[i]),
                              .y = y(data.truth[i]),
                              .mark = Mark::kDashes,
                              .colour = -1});
    }
  };
  const bool is_few = data.tracks.size() <= kFew;
  if (!is_few) add_truth();  // below the tracks of a crowd, which it would hide
  const auto name_of = [&](std::size_t i) -> std::string {
    if (!along_path) return "";  // one legend for all panels
    if (is_few) return "track " + data.tracks[i].name;
    return i == 0 ? fmt::format("one of {} tracks", data.tracks.size()) : "";
  };
  for (std::size_t i = 0; i < data.tracks.size(); ++i) {
    panel.curves.push_back({.name = name_of(i),
                            .x = x_of(data.tracks[i]),
                            .y = y(data.tracks[i]),
                            .mark = Mark::kLine,
                            .colour = static_cast<int>(i)});
  }
  if (is_few) add_truth();
  return panel;
}

Panel quantity(const Data& data, const std::string& title, const std::string& y_label,
               Quantity which, Mark mark) {
  Panel panel{.title = title, .x_label = data.time_label(), .y_label = y_label};
  for (std::size_t i = 0; i < data.tracks.size(); ++i) {
    panel.curves.push_back({.name = "",
                            .x = data.shifted(data.tracks[i].t),
                            .y = data.tracks[i].of(which),
                            .mark = mark,
                            .colour = static_cast<int>(i)});
  }
  return panel;
}

/// Residuals with their bounds: twice what the tracker expects, or twice their root mean square.
Panel residuals(const Data& data, const std::string& title, Quantity which, Quantity expected) {
  Panel panel =
      quantity(data, title, fmt::format("z − prior [{}]", data.unit()), which, Mark::kDots);
  if (data.has(expected) && data.tracks.size() <= kFew) {
    for (std::size_t i = 0; i < data.tracks.size(); ++i) {
      Band band{.name = i == 0 ? "± 2 expected" : "",
                .x = data.shifted(data.tracks[i].t),
                .low = {},
                .high = {},
                .colour = static_cast<int>(i)};
      for (const double s : data.tracks[i].of(expected)) {
        band.low.push_back(-2.0 * s);
        band.high.push_back(2.0 * s);
      }
      panel.bands.push_back(std::move(band));
    }
    return panel;
  }
  double sum = 0.0;
  std::size_t count = 0;
  for (const TrackCurves& track : data.tracks) {
    for (const double r : track.of(which)) {
      if (!std::isfinite(r)) continue;
      sum += r * r;
      ++count;
    }
  }
  if (count == 0) return panel;
  const double rms = std::sqrt(sum / static_cast<double>(count));
  panel.levels = {{2.0 * rms, "+ 2 rms"}, {-2.0 * rms, "− 2 rms"}};
  return panel;
}

/// Of all tracks at all times; NaN without any.
double median_sigma(const Data& data, std::vector<double> ErrorCurves::*sigma) {
  std::vector<double> all;
  for (const auto& [name, curves] : data.errors) {
    for (const double s : curves.*sigma) {
      if (std::isfinite(s)) all.push_back(s);
    }
  }
  if (all.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

Panel errors(const Data& data, const std::string& axis, std::vector<double> ErrorCurves::*error,
             std::vector<double> ErrorCurves::*sigma) {
  Panel panel{.title = fmt::format("error in {}", axis),
              .x_label = data.time_label(),
              .y_label = fmt::format("estimate − truth [{}]", data.unit())};
  int number = 0;
  for (const TrackCurves& track : data.tracks) {
    const int colour = number++;
    const auto found = data.errors.find(track.name);
    if (found == data.errors.end()) continue;
    const ErrorCurves& curves = found->second;
    if (data.tracks.size() <= kFew) {
      Band band{.name = panel.bands.empty() ? "± sigma" : "",
                .x = curves.t,
                .low = {},
                .high = {},
                .colour = colour};
      for (const double s : curves.*sigma) {
        band.low.push_back(-s);
        band.high.push_back(s);
      }
      panel.bands.push_back(std::move(band));
    }
    panel.curves.push_back(
        {.name = "", .x = curves.t, .y = curves.*error, .mark = Mark::kLine, .colour = colour});
  }
  if (data.tracks.size() > kFew) {  // bands would hide one another
    const double usual = median_sigma(data, sigma);
    if (std::isfinite(usual)) {
      panel.levels = {{usual, "+ sigma (median)"}, {-usual, "− sigma (median)"}};
    }
  }
  return panel;
}

Panel consistency(const Data& data, const std::string& title,
                  const std::vector<std::pair<std::vector<double>, std::vector<double>>>& curves) {
  Panel panel{.title = title,
              .x_label = data.time_label(),
              .y_label = title,
              .levels = {{2.0, "expected: 2"}, {kUpper95, "95 %"}},
              .y_from = 0.0};
  std::vector<double> all;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    panel.curves.push_back({.name = "",
                            .x = curves[i].first,
                            .y = curves[i].second,
                            .mark = Mark::kDots,
                            .colour = static_cast<int>(i)});
    for (const double value : curves[i].second) {
      if (std::isfinite(value)) all.push_back(value);
    }
  }
  if (all.empty()) return panel;
  // Single values far out must not press the others flat.
  const auto high = all.begin() + static_cast<std::ptrdiff_t>((all.size() - 1) * 98 / 100);
  std::nth_element(all.begin(), high, all.end());
  panel.y_to = std::max(1.3 * kUpper95, 1.2 * *high);
  return panel;
}

Panel nees(const Data& data) {
  std::vector<std::pair<std::vector<double>, std::vector<double>>> curves;
  for (const TrackCurves& track : data.tracks) {
    auto& [t, value] = curves.emplace_back();
    const auto found = data.errors.find(track.name);
    if (found == data.errors.end()) continue;
    const ErrorCurves& e = found->second;
    t = e.t;
    for (std::size_t i = 0; i < e.t.size(); ++i) {
      value.push_back(std::pow(e.x[i] / e.sigma_x[i], 2) + std::pow(e.y[i] / e.sigma_y[i], 2));
    }
  }
  return consistency(data, "NEES", curves);
}

Panel nis(const Data& data) {
  std::vector<std::pair<std::vector<double>, std::vector<double>>> curves;
  for (const TrackCurves& track : data.tracks) {
    auto& [t, value] = curves.emplace_back(data.shifted(track.t), std::vector<double>{});
    for (std::size_t i = 0; i < track.t.size(); ++i) {
      value.push_back(std::pow(track.of(Quantity::kRx)[i] / track.of(Quantity::kSx)[i], 2) +
                      std::pow(track.of(Quantity::kRy)[i] / track.of(Quantity::kSy)[i], 2));
    }
  }
  return consistency(data, "NIS", curves);
}

std::optional<Panel> panel_named(const std::string& name, const Data& data) {
  const std::string unit = data.unit();
  if (name == "path") {
    Panel panel = positions(
        data, "path", fmt::format("y [{}]", unit),
        [](const TrackCurves& c) -> const auto& { return c.y; }, true);
    panel.equal_scales = true;
    return panel;
  }
  if (name == "x") {
    return positions(
        data, "x", fmt::format("x [{}]", unit),
        [](const TrackCurves& c) -> const auto& { return c.x; }, false);
  }
  if (name == "y") {
    return positions(
        data, "y", fmt::format("y [{}]", unit),
        [](const TrackCurves& c) -> const auto& { return c.y; }, false);
  }
  const auto velocity = [&](const char* title, Quantity which) -> std::optional<Panel> {
    if (!data.has(which)) return std::nullopt;
    Panel panel = quantity(data, title, fmt::format("{} [{}/s]", title, unit), which, Mark::kLine);
    for (const TrackCurves& object : data.truth) {
      if (object.of(which).empty()) continue;
      panel.curves.push_back({.name = "",
                              .x = data.shifted(object.t),
                              .y = object.of(which),
                              .mark = Mark::kDashes,
                              .colour = -1});
    }
    return panel;
  };
  if (name == "vx") return velocity("vx", Quantity::kVx);
  if (name == "vy") return velocity("vy", Quantity::kVy);
  if (name == "error_x" && !data.errors.empty()) {
    return errors(data, "x", &ErrorCurves::x, &ErrorCurves::sigma_x);
  }
  if (name == "error_y" && !data.errors.empty()) {
    return errors(data, "y", &ErrorCurves::y, &ErrorCurves::sigma_y);
  }
  if (name == "residual_x" && data.has(Quantity::kRx)) {
    return residuals(data, "residual in x", Quantity::kRx, Quantity::kSx);
  }
  if (name == "residual_y" && data.has(Quantity::kRy)) {
    return residuals(data, "residual in y", Quantity::kRy, Quantity::kSy);
  }
  if (name == "nees" && !data.errors.empty() && data.has(Quantity::kSigmaX)) return nees(data);
  if (name == "nis" && data.has(Quantity::kRx) && data.has(Quantity::kSx)) return nis(data);
  if (name == "existence" && data.has(Quantity::kExistence)) {
    Panel panel = quantity(data, "existence", "probability", Quantity::kExistence, Mark::kLine);
    panel.y_from = 0.0;
    panel.y_to = 1.05;
    return panel;
  }
  return std::nullopt;
}

}  // namespace

const std::vector<std::string>& track_panels() {
  static const std::vector<std::string> kPanels = {"path",       "x",       "y",       "vx",
                                                   "vy",         "error_x", "error_y", "residual_x",
                                                   "residual_y", "nees",    "nis",     "existence"};
  return kPanels;
}

Figure figure_of(const TrackPlot& plot) {
  const Data data = load(plot);
  Figure figure{.title = plot.title, .panels = {}};
  for (const std::string& name : plot.panels.empty() ? track_panels() : plot.panels) {
    if (auto panel = panel_named(name, data)) figure.panels.push_back(std::move(*panel));
  }
  return figure;
}

}  // namespace ghtrack::plot

#include "tools/render/error_plot.hpp"

#include <algorithm>
#include <cmath>

#include "tools/render/chart.hpp"

namespace ghtrack::render {

namespace {

constexpr int kMostPoints = 1000;  // on a curve: no picture resolves more

}  // namespace

void ErrorPlot::add(double time, const std::vector<std::optional<double>>& errors) {
  curves_.resize(std::max(curves_.size(), errors.size()));
  const double least_step = (to_ - from_) / kMostPoints;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    std::vector<Point>& curve = curves_[i];
    const bool is_due = curve.empty() || time - curve.back().time >= least_step;
    if (is_due && errors[i] && std::isfinite(*errors[i])) curve.push_back({time, *errors[i]});
  }
}

void ErrorPlot::draw(Canvas& canvas, const Viewport& area, const Style& style,
                     const Typefaces& fonts) const {
  double highest = 0.0;
  for (const std::vector<Point>& curve : curves_)
    for (const Point& point : curve) highest = std::max(highest, point.error);
  const Chart chart(area, {from_, to_}, from_zero_to(highest), style, fonts);
  chart.draw_axes(canvas, U"running RMSE of position [m]");
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    std::vector<Pixel> line;
    for (const Point& point : curves_[i]) line.push_back(chart.at(point.time, point.error));
    canvas.polyline(line, style.theme().track(static_cast<int>(i)), style.length(2));
  }
}

}  // namespace ghtrack::render

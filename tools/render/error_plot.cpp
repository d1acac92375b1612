#include "tools/render/error_plot.hpp"

#include <algorithm>
#include <cmath>

#include "tools/render/chart.hpp"

namespace ghtrack::render {

namespace {

constexpr int kMostPoints = 1000;  // on a curve: no picture resolves more

}  // namespace

void ErrorPlot::add(std::size_t tracker, const ScanReport& report) {
  if (!report.rmse || !std::isfinite(*report.rmse)) return;
  curves_.resize(std::max(curves_.size(), tracker + 1));
  std::vector<Point>& curve = curves_[tracker];
  const double time = report.tracks.time;
  const bool is_due = curve.empty() || time - curve.back().time >= (to_ - from_) / kMostPoints;
  if (is_due) curve.push_back({time, *report.rmse});
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

#include "tools/render/error_plot.hpp"

#include <algorithm>
#include <cmath>

#include "tools/render/ticks.hpp"

namespace ghtrack::render {

namespace {

constexpr int kMostPoints = 2000;  // on a curve: no picture resolves more

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
  const Viewport box{area.left + style.length(64), area.top + style.length(14),
                     area.width - style.length(84), area.height - style.length(38)};
  double highest = 1e-3;
  for (const std::vector<Point>& curve : curves_)
    for (const Point& point : curve) highest = std::max(highest, point.error);
  const double step = round_step(highest / 3.0);
  const double top = step * std::ceil(1.02 * highest / step);
  const auto at = [&](double time, double error) {
    return Pixel{box.left + box.width * (time - from_) / (to_ - from_),
                 box.bottom() - box.height * error / top};
  };

  canvas.rectangle(area, dark::kWorld);
  const int letters = style.letters(12);
  for (const double error : round_ticks(0.0, top, static_cast<int>(std::lround(top / step)))) {
    canvas.line(at(from_, error), at(to_, error), dark::kMajorGrid);
    canvas.text(fonts.regular, tick_label(error, step), letters,
                {box.left - style.length(6), at(from_, error).y + 0.35 * letters}, dark::kAxisText,
                Canvas::Align::kRight);
  }
  const std::vector<double> times = round_ticks(from_, to_, 10);
  const double time_step = times.size() > 1 ? times[1] - times[0] : 1.0;
  for (const double time : times) {
    canvas.line(at(time, 0.0), at(time, top), dark::kMinorGrid);
    canvas.text(fonts.regular, tick_label(time, time_step) + (time == times.back() ? U" s" : U""),
                letters, {at(time, 0.0).x, box.bottom() + 1.4 * letters}, dark::kAxisText,
                Canvas::Align::kCentre);
  }
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const Color color = track_color(static_cast<int>(i) + 1);
    for (std::size_t k = 1; k < curves_[i].size(); ++k)
      canvas.line(at(curves_[i][k - 1].time, curves_[i][k - 1].error),
                  at(curves_[i][k].time, curves_[i][k].error), color, style.length(2));
  }
  canvas.text(fonts.regular, U"running RMSE of position [m]", style.letters(13),
              {box.left + style.length(10), box.top + style.length(12)}, dark::kMutedText);
}

}  // namespace ghtrack::render

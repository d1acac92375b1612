#include "tools/render/chart.hpp"

#include <algorithm>
#include <cmath>

#include "tools/render/ticks.hpp"

namespace ghtrack::render {

namespace {

constexpr double kColumn = 110.0;    // [px] between numbers along the time axis, about
constexpr double kNumberRow = 34.0;  // [px] between numbers along the other, about

double step_of(const std::vector<double>& ticks) {
  return ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
}

}  // namespace

Range from_zero_to(double highest) {
  const double step = round_step(std::max(highest, 1e-3) / 3.0);
  return {0.0, step * std::ceil(1.02 * std::max(highest, 1e-3) / step)};
}

Chart::Chart(const Viewport& area, const Range& times, const Range& values, const Style& style,
             const Typefaces& fonts)
    : area_(area),
      box_{area.left + style.length(52), area.top + style.length(24), area.width - style.length(74),
           area.height - style.length(46)},
      times_(times),
      values_(values),
      style_(style),
      fonts_(fonts) {}

Pixel Chart::at(double time, double value) const {
  return {box_.left + box_.width * (time - times_.low) / (times_.high - times_.low),
          box_.bottom() - box_.height * (value - values_.low) / (values_.high - values_.low)};
}

void Chart::draw_axes(Canvas& canvas, std::u32string_view title) const {
  canvas.rectangle(area_, style_.theme().world);
  const int letters = style_.letters(13);
  const auto count = [&](double length, double spacing) {
    return std::max(1, static_cast<int>(length / style_.length(spacing)));
  };
  const std::vector<double> values =
      round_ticks(values_.low, values_.high, count(box_.height, kNumberRow));
  for (const double value : values) {
    const Pixel left = at(times_.low, value);
    canvas.line(left, at(times_.high, value), style_.theme().major_grid);
    canvas.text(fonts_.regular, tick_label(value, step_of(values)), letters,
                {left.x - style_.length(6), left.y + 0.35 * letters}, style_.theme().axis_text,
                Canvas::Align::kRight);
  }
  const std::vector<double> times =
      round_ticks(times_.low, times_.high, count(box_.width, kColumn));
  for (const double time : times) {
    const Pixel foot = at(time, values_.low);
    canvas.line(foot, at(time, values_.high), style_.theme().minor_grid);
    canvas.text(fonts_.regular, tick_label(time, step_of(times)) + U" s", letters,
                {foot.x, box_.bottom() + 1.4 * letters}, style_.theme().axis_text,
                Canvas::Align::kCentre);
  }
  canvas.text(fonts_.regular, title, style_.letters(13), {box_.left, area_.top + style_.length(17)},
              style_.theme().muted_text);
}

}  // namespace ghtrack::render

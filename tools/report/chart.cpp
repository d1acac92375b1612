#include "tools/report/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/html/template.hpp"

namespace ghtrack::report {
namespace {

// Around the space between the axes, in half pixels like all lengths here.
constexpr int kLeft = 112;
constexpr int kRight = 18;
constexpr int kTop = 16;
constexpr int kBottom = 84;
constexpr int kFarOutside = 4000;

std::string label_of(double value) {
  std::string text = fmt::format("{:.6g}", value);
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

template <class Place>
double distance_to_segment(const Place& point, const Place& from, const Place& to) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double px = point.x - from.x;
  const double py = point.y - from.y;
  const double length = dx * dx + dy * dy;
  const double share = length > 0.0 ? std::clamp((px * dx + py * dy) / length, 0.0, 1.0) : 0.0;
  return std::hypot(px - share * dx, py - share * dy);
}

/// Two numbers of a path; a minus sign separates as well as a space.
std::string pair_of(int x, int y, bool is_first) {
  return fmt::format("{}{}{}{}", is_first || x < 0 ? "" : " ", x, y < 0 ? "" : " ", y);
}

}  // namespace

double Axis::share(double value) const {
  if (logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

Axis linear_axis(std::string label, double low, double high, int count) {
  Axis axis{.label = std::move(label), .low = low, .high = high, .logarithmic = false, .ticks = {}};
  const double least = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) step = factor * power;
  }
  const double last = std::floor(high / step + 1e-9);
  for (double n = std::ceil(low / step - 1e-9); n <= last; n += 1.0) {
    axis.ticks.emplace_back(n * step, label_of(n == 0.0 ? 0.0 : n * step));
  }
  return axis;
}

Axis logarithmic_axis(std::string label, double low, double high) {
  constexpr double kManyDecades = 2000.0;
  Axis axis{.label = std::move(label), .low = low, .high = high, .logarithmic = true, .ticks = {}};
  const bool decades_only = high / low > kManyDecades;
  const double last = std::log10(high);
  for (double exponent = std::floor(std::log10(low)); exponent <= last + 1e-9; exponent += 1.0) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, exponent);
      const bool inside = value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9);
      if (inside && (!decades_only || factor == 1.0)) {
        axis.ticks.emplace_back(value, label_of(value));
      }
    }
  }
  return axis;
}

Chart::Chart(std::string title, Axis x, Axis y, int height)
    : title_(std::move(title)), x_(std::move(x)), y_(std::move(y)), height_(height) {}

bool Chart::is_drawable(ChartPoint point) const {
  return std::isfinite(x_.share(point.x)) && std::isfinite(y_.share(point.y));
}

Chart::Place Chart::place(ChartPoint point) const {
  const auto rounded = [](double share, int size) {
    return static_cast<int>(
        std::lround(std::clamp<double>(share * size, -kFarOutside, kFarOutside)));
  };
  return {rounded(x_.share(point.x), kWidth), rounded(1.0 - y_.share(point.y), height_)};
}

/// A path through the points, relative and without steps of no length: short.
std::string Chart::path(std::span<const ChartPoint> points) const {
  std::string text;
  Place at;
  for (const ChartPoint& point : points) {
    if (!is_drawable(point)) continue;
    const Place next = place(point);
    if (text.empty()) {
      text = fmt::format("M{} {}l", next.x, next.y);
    } else if (next.x != at.x || next.y != at.y) {
      text += pair_of(next.x - at.x, next.y - at.y, text.back() == 'l');
    }
    at = next;
  }
  if (text.ends_with('l')) text += "0 0";
  return text;
}

std::vector<ChartPoint> Chart::simplified(std::span<const ChartPoint> points,
                                          double tolerance) const {
  std::vector<ChartPoint> drawable;
  std::copy_if(points.begin(), points.end(), std::back_inserter(drawable),
               [&](const ChartPoint& point) { return is_drawable(point); });
  if (drawable.size() < 3) return drawable;

  std::vector<bool> kept(drawable.size());
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> to_do = {{0, drawable.size() - 1}};
  while (!to_do.empty()) {
    const auto [first, last] = to_do.back();
    to_do.pop_back();
    double farthest = tolerance;
    std::size_t corner = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance =
          distance_to_segment(place(drawable[i]), place(drawable[first]), place(drawable[last]));
      if (distance <= farthest) continue;
      farthest = distance;
      corner = i;
    }
    if (corner == first) continue;
    kept[corner] = true;
    to_do.emplace_back(first, corner);
    to_do.emplace_back(corner, last);
  }
  std::vector<ChartPoint> left;
  for (std::size_t i = 0; i < drawable.size(); ++i) {
    if (kept[i]) left.push_back(drawable[i]);
  }
  return left;
}

void Chart::line(std::span<const ChartPoint> points, std::string_view css) {
  shapes_.emplace_back(fmt::format("line {}", css), path(points));
}

void Chart::band(std::span<const ChartPoint> low, std::span<const ChartPoint> high,
                 std::string_view css) {
  std::vector<ChartPoint> outline(low.begin(), low.end());
  outline.insert(outline.end(), high.rbegin(), high.rend());
  shapes_.emplace_back(fmt::format("band {}", css), path(outline));
}

void Chart::dots(std::span<const ChartPoint> points, std::string_view css) {
  std::string text;
  Place at;
  for (const ChartPoint& point : points) {
    if (!is_drawable(point)) continue;
    const Place next = place(point);
    text += (text.empty() ? "M" : "m") + pair_of(next.x - at.x, next.y - at.y, true) + "h0";
    at = next;
  }
  shapes_.emplace_back(fmt::format("dots {}", css), text);
}

void Chart::rectangle(ChartPoint from, ChartPoint to, std::string_view css) {
  const Place a = place(from);
  const Place b = place(to);
  const std::string name = fmt::format("area {}", css);
  const auto known = std::find_if(shapes_.begin(), shapes_.end(),
                                  [&](const auto& shape) { return shape.first == name; });
  std::string& text =
      known != shapes_.end() ? known->second : shapes_.emplace_back(name, "").second;
  fmt::format_to(std::back_inserter(text), "M{} {}H{}V{}H{}z", a.x, a.y, b.x, b.y, a.x);
}

void Chart::mark(ChartPoint at, std::string_view css, std::string_view hint) {
  if (!is_drawable(at)) return;
  const Place centre = place(at);
  marks_ += fmt::format(
      "<circle class=\"mark {}\" cx=\"{}\" cy=\"{}\" r=\"11\"><title>{}</title></circle>", css,
      centre.x, centre.y, html::escaped(hint));
}

void Chart::star(ChartPoint at, std::string_view css, std::string_view hint) {
  constexpr double kTenthOfTurn = 0.6283185307179586;
  if (!is_drawable(at)) return;
  const Place centre = place(at);
  std::string corners;
  for (int i = 0; i < 10; ++i) {
    const double radius = i % 2 == 0 ? 20.0 : 9.0;
    corners += fmt::format("{:.0f},{:.0f} ", centre.x + radius * std::sin(kTenthOfTurn * i),
                           centre.y - radius * std::cos(kTenthOfTurn * i));
  }
  marks_ += fmt::format("<polygon class=\"mark {}\" points=\"{}\"><title>{}</title></polygon>", css,
                        corners, html::escaped(hint));
}

std::string Chart::axes() const {
  std::string grid;
  std::string across;
  std::string up;
  for (const auto& [value, label] : y_.ticks) {
    const int y = kTop + place({x_.low, value}).y;
    grid += fmt::format("M{} {}h{}", kLeft, y, kWidth);
    up += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", kLeft - 12, y + 9, label);
  }
  for (const auto& [value, label] : x_.ticks) {
    const int x = kLeft + place({value, y_.low}).x;
    grid += fmt::format("M{} {}v{}", x, kTop, height_);
    across += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", x, kTop + height_ + 32, label);
  }
  up += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", kLeft + kWidth, kTop + height_ + 68,
                    html::escaped(x_.label));
  up += fmt::format("<text transform=\"translate(26 {}) rotate(-90)\">{}</text>", kTop,
                    html::escaped(y_.label));
  return fmt::format(
      "<path class=\"grid\" d=\"{}\"/><g class=\"end\">{}</g><g class=\"middle\">{}</g>", grid, up,
      across);
}

std::string Chart::svg() const {
  std::string text = fmt::format(
      "<svg class=\"chart\" role=\"img\" viewBox=\"0 0 {} {}\"><title>{}</title>{}"
      "<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">",
      kLeft + kWidth + kRight, kTop + height_ + kBottom, html::escaped(title_), axes(), kLeft, kTop,
      kWidth, height_);
  for (const auto& [css, path] : shapes_) {
    if (!path.empty()) text += fmt::format("<path class=\"{}\" d=\"{}\"/>", css, path);
  }
  text += marks_;
  text += fmt::format(
      "</svg><rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></svg>", kLeft,
      kTop, kWidth, height_);
  return text;
}

}  // namespace ghtrack::report

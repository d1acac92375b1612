#include "tools/plot/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ghtrack::plot {

namespace {

/// A tick with the decimals that the step needs.
std::string number_at(const Axis& axis, double tick) {
  if (axis.is_logarithmic) return fmt::format("{:.3g}", std::pow(10.0, tick));
  tick -= axis.offset;
  const double largest =
      std::max(std::abs(axis.low - axis.offset), std::abs(axis.high - axis.offset));
  if (largest >= 1e6 || (largest > 0.0 && largest < 1e-3)) {
    return std::abs(tick) < 1e-9 * largest ? "0" : fmt::format("{:.4g}", tick);
  }
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(axis.step) + 1e-9)));
  const std::string text = fmt::format("{:.{}f}", tick, decimals);
  return text.find_first_not_of("-0.") == std::string::npos ? fmt::format("{:.{}f}", 0.0, decimals)
                                                            : text;
}

}  // namespace

double Axis::share(double value) const {
  return ((is_logarithmic ? std::log10(value) : value) - low) / span();
}

std::string Axis::label(double tick) const {
  if (!names.empty()) return names.at(static_cast<std::size_t>(std::lround(tick)));
  std::string text = number_at(*this, tick);
  if (text.starts_with('-')) text.replace(0, 1, "−");  // as wide as a plus sign
  return text;
}

std::string Axis::title(const std::string& name) const {
  return offset == 0.0 ? name : fmt::format("{}, less {:.0f}", name, offset);
}

namespace {

/// What stands in front of all numbers of a far axis: 5400000 of 5400010 … 5400090.
double offset_of(const Axis& axis) {
  constexpr double kLong = 1e6;   // more digits than find room
  constexpr double kFar = 100.0;  // spans away
  const double nearest = std::min(std::abs(axis.low), std::abs(axis.high));
  if (nearest < std::max(kLong, kFar * axis.span())) return 0.0;
  const double power = std::pow(10.0, std::ceil(std::log10(axis.span())));
  return std::floor(axis.low / power) * power;
}

/// Round numbers, about so many, and two at least: one alone says nothing of the scale.
void take_ticks(Axis& axis, double count) {
  const double rough = axis.span() / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double unit = rough / power;
  axis.step = power * (unit < 1.5 ? 1.0 : unit < 3.5 ? 2.0 : unit < 7.5 ? 5.0 : 10.0);
  const auto first = static_cast<long>(std::ceil(axis.low / axis.step - 1e-9));
  const auto last = static_cast<long>(std::floor(axis.high / axis.step + 1e-9));
  if (last <= first) return take_ticks(axis, 1.5 * count);
  for (long i = first; i <= last && i - first < 100; ++i) {
    axis.ticks.push_back(static_cast<double>(i) * axis.step);
  }
}

}  // namespace

Axis axis_over(double low, double high, double ticks, bool tight) {
  Axis axis;
  if (!(low <= high)) return axis_over(0.0, 1.0, ticks, tight);
  if (high - low <= 1e-9 * std::max(std::abs(low), std::abs(high)) || low == high) {
    const double reach = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
    low -= reach;
    high += reach;
  }
  const double margin = tight ? 0.0 : 0.05 * (high - low);
  axis.low = low - margin;
  axis.high = high + margin;
  take_ticks(axis, std::max(2.0, ticks));
  axis.offset = offset_of(axis);
  return axis;
}

Axis logarithmic_axis_over(double low, double high) {
  if (!(low > 0.0 && low <= high)) return logarithmic_axis_over(1.0, 10.0);
  Axis axis;
  axis.is_logarithmic = true;
  const double margin = std::max(0.02, 0.05 * std::log10(high / low));
  axis.low = std::log10(low) - margin;
  axis.high = std::log10(high) + margin;
  axis.step = 1.0;
  const bool is_short = axis.span() < 3.0;
  for (double decade = std::floor(axis.low); decade <= axis.high; decade += 1.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double tick = decade + std::log10(digit);
      const bool is_shown = digit == 1.0 || is_short;
      if (is_shown && tick >= axis.low && tick <= axis.high) axis.ticks.push_back(tick);
    }
  }
  return axis;
}

Axis axis_of(const std::vector<std::string>& names) {
  Axis axis;
  axis.names = names;
  axis.low = -0.6;
  axis.high = static_cast<double>(names.size()) - 0.4;
  axis.step = 1.0;
  for (std::size_t i = 0; i < names.size(); ++i) axis.ticks.push_back(static_cast<double>(i));
  return axis;
}

}  // namespace ghtrack::plot

#pragma once

#include <string>
#include <vector>

namespace ghtrack::plot {

/// A range of values and the round numbers in it. On a logarithmic one all of these are decimal
/// logarithms.
struct Axis {
  double low = 0.0, high = 1.0;
  double step = 0.2;  // 1, 2 or 5 times a power of ten
  std::vector<double> ticks;
  std::vector<std::string> names = {};  // of the ticks, instead of numbers
  bool is_logarithmic = false;
  double offset = 0.0;  // taken off the numbers at the ticks, which would be too long

  double span() const { return high - low; }
  /// Where a value lies, from 0 at the low end to 1 at the high one.
  double share(double value) const;
  /// A tick as text, with the decimals that the step needs, or by its name.
  std::string label(double tick) const;
  /// What the axis is called, and what was taken off its numbers.
  std::string title(const std::string& name) const;
};

/// An axis over [low, high], a little wider, with about so many ticks, and two at least.
Axis axis_over(double low, double high, double ticks, bool tight);

/// A logarithmic axis over [low, high], both above zero, with ticks at powers of ten, and at 2 and
/// 5 times these where there are few.
Axis logarithmic_axis_over(double low, double high);

/// An axis with a tick for each of these, at 0, 1, …
Axis axis_of(const std::vector<std::string>& names);

}  // namespace ghtrack::plot

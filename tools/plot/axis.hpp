#pragma once

#include <string>
#include <vector>

namespace ghtrack::plot {

/// A range of values and the round numbers in it.
struct Axis {
  double low = 0.0, high = 1.0;
  double step = 0.2;  // 1, 2 or 5 times a power of ten
  std::vector<double> ticks;

  double span() const { return high - low; }
  /// A tick as text, with the decimals that the step needs.
  std::string label(double tick) const;
};

/// An axis over [low, high], a little wider, with about so many ticks.
Axis axis_over(double low, double high, double ticks, bool tight);

}  // namespace ghtrack::plot

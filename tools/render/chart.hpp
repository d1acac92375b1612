#pragma once

#include <string_view>

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"

namespace ghtrack::render {

/// A range of numbers along an axis.
struct Range {
  double low = 0.0;
  double high = 1.0;
};

/// A small diagram over time: round numbers along both axes, a title, curves.
class Chart {
 public:
  /// @param area   with room for the numbers
  /// @param times  [s]
  Chart(const Viewport& area, const Range& times, const Range& values, const Style& style,
        const Typefaces& fonts);

  void draw_axes(Canvas& canvas, std::u32string_view title) const;
  Pixel at(double time, double value) const;
  const Viewport& box() const { return box_; }

 private:
  Viewport area_;
  Viewport box_;  // of the curves
  Range times_;
  Range values_;
  const Style& style_;
  const Typefaces& fonts_;
};

/// From zero to a round number that is not less than `highest`.
Range from_zero_to(double highest);

}  // namespace ghtrack::render

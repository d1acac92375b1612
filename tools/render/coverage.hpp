#pragma once

#include <cstdint>
#include <vector>

#include "tools/render/view.hpp"

namespace ghtrack::render {

/// How much of each pixel some strokes cover, 0 to 255. Where strokes meet, the stronger counts, so
/// that a line has no knots at its corners and ends. A pixel's share is taken from the distance of
/// its centre to the stroke's edge, which is exact for straight edges along the axes and right to a
/// few per cent otherwise.
class Coverage {
 public:
  /// @param width,height of the image; strokes are cut at its edges
  Coverage(int width, int height) : width_(width), height_(height) {}

  /// Starts anew with room for what lies within these corners [px].
  void clear(Pixel min, Pixel max);

  /// A line with round ends.
  void add_line(Pixel from, Pixel to, double thickness, double opacity);

  void add_ring(Pixel centre, double radius, double thickness, double opacity);
  void add_disc(Pixel centre, double radius, double opacity);
  void add_polygon(const std::vector<Pixel>& corners, double opacity);  // convex, any direction

  int left() const { return left_; }
  int top() const { return top_; }
  int right() const { return right_; }
  int bottom() const { return bottom_; }
  const std::uint8_t* row(int y) const {
    return shares_.data() + static_cast<std::ptrdiff_t>(y - top_) * (right_ - left_);
  }

 private:
  struct Span;
  template <class RowSpan, class Distance>
  void add(double top, double bottom, double opacity, RowSpan span, Distance distance);

  int width_;
  int height_;
  int left_ = 0;  // the part in use: columns [left, right), rows [top, bottom)
  int top_ = 0;
  int right_ = 0;
  int bottom_ = 0;
  std::vector<std::uint8_t> shares_;
};

}  // namespace ghtrack::render

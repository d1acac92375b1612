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

  int top() const { return top_; }
  int bottom() const { return bottom_; }

  /// The pixels [first, last) of a row that may be covered; outside nothing is.
  struct Span {
    int first, last;
  };
  Span span(int y) const { return spans_[static_cast<std::size_t>(y - top_)]; }

  /// Of a pixel within the span of its row.
  const std::uint8_t* share(int x, int y) const {
    return shares_.data() + static_cast<std::ptrdiff_t>(y - top_) * (right_ - left_) + (x - left_);
  }

 private:
  struct Reach;
  template <class RowReach, class Distance>
  void add(double top, double bottom, double opacity, RowReach reach, Distance distance);
  void widen(int y, int first, int last);

  int width_;
  int height_;
  int left_ = 0;  // the part in use: columns [left, right), rows [top, bottom)
  int top_ = 0;
  int right_ = 0;
  int bottom_ = 0;
  std::vector<std::uint8_t> shares_;
  std::vector<Span> spans_;  // of the rows
};

}  // namespace ghtrack::render

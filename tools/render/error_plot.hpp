#pragma once

#include <cstddef>
#include <vector>

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::render {

/// The running errors of one or several trackers over the scene's time.
class ErrorPlot {
 public:
  ErrorPlot(double from, double to) : from_(from), to_(to) {}

  /// Takes note of what one of the trackers says after a scan.
  void add(std::size_t tracker, const ScanReport& report);

  void draw(Canvas& canvas, const Viewport& area, const Style& style, const Typefaces& fonts) const;

 private:
  struct Point {
    double time, error;
  };
  double from_;
  double to_;
  std::vector<std::vector<Point>> curves_;  // by tracker
};

}  // namespace ghtrack::render

#pragma once

#include <vector>

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"

namespace ghtrack::render {

/// The running errors of one or several trackers over the scene's time.
class ErrorPlot {
 public:
  ErrorPlot(double from, double to) : from_(from), to_(to) {}

  /// @param errors [m], one per tracker; an absent one is a gap
  void add(double time, const std::vector<std::optional<double>>& errors);

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

#pragma once

#include "tools/plot/canvas.hpp"
#include "tools/plot/figure.hpp"

namespace ghtrack::plot {

struct Rectangle {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// Draws a panel into a rectangle, its labels, ticks and legend included.
void draw_panel(Canvas& canvas, const Panel& panel, const Rectangle& place, const Palette& palette,
                double font_size);

}  // namespace ghtrack::plot

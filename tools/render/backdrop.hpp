#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/stage.hpp"

namespace ghtrack::render {

/// Does a view have numbers along its edges?
enum class AxisNumbers { kShown, kHidden };

/// Draws what does not move: grid, ground, walls, rails, fields of view, scale bar.
void draw_backdrop(Canvas& canvas, const Stage& stage, AxisNumbers numbers);

/// Where the names of fields of view are written, for labels to keep away.
std::vector<Viewport> view_name_boxes(const Stage& stage);

/// Where draw_backdrop() draws the scale bar with its number.
Viewport scale_bar_box(const Stage& stage);

}  // namespace ghtrack::render

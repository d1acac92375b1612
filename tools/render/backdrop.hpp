#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/stage.hpp"

namespace ghtrack::render {

/// Does a view have numbers along its edges?
enum class AxisNumbers { kShown, kHidden };

/// Draws what does not move: grid, ground, walls, rails, fields of view.
void draw_backdrop(Canvas& canvas, const Stage& stage, AxisNumbers numbers);

/// Where the names of fields of view are written, for labels to keep away.
std::vector<Viewport> view_name_boxes(const Stage& stage);

/// A bar to measure with and its length, above whatever moves there.
void draw_scale_bar(Canvas& canvas, const Stage& stage);

/// Where that is.
Viewport scale_bar_box(const Stage& stage);

}  // namespace ghtrack::render

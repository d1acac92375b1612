#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"

namespace ghtrack::render {

/// Draws what does not move: grid with metres, field of view, ground, walls, rails, scale bar.
/// @param canvas limited to the view's viewport
void draw_backdrop(Canvas& canvas, const View& view, const SceneDrawing& scene, Layers layers,
                   const Style& style, const Typefaces& fonts);

}  // namespace ghtrack::render

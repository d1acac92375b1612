#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"

namespace ghtrack::render {

/// Writes above a picture which scene it shows, when, and how the tracker is doing.
void draw_hud(Canvas& canvas, const Viewport& area, const VideoOptions& options,
              const SceneDrawing& scene, const VideoFrame& frame, const Style& style,
              const Typefaces& fonts);

/// Writes above one of several panels whose it is, and how it is doing.
/// @param leads  its GOSPA is the least so far
void draw_header(Canvas& canvas, const Viewport& area, const PanelDrawing& drawing,
                 const PanelFrame& panel, Color color, bool leads, const Style& style,
                 const Typefaces& fonts);

}  // namespace ghtrack::render

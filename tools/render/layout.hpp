#pragma once

#include <vector>

#include "tools/render/style.hpp"
#include "tools/render/view.hpp"

namespace ghtrack::render {

/// Where the parts of a picture lie. Parts that are not shown have no height.
struct Layout {
  Viewport hud;
  std::vector<Viewport> headers;  // of the panels, when there are several
  std::vector<Viewport> panels;   // what shows the world, one for each compared filter
  Viewport plots;                 // over time
  std::vector<std::vector<Viewport>> close_ups;  // on top of each panel, or beside it
  Viewport legend;
};

/// Arranges the panels so that the world is shown as large as possible.
/// @param legend_height  [px]
Layout lay_out(const VideoOptions& options, const SceneDrawing& scene, const Style& style,
               double legend_height);

/// Close-ups that say no corner get the first in which all of them hide nobody during the whole
/// run, if need be smaller; if there is none, they stay without and lie beside the panel.
std::vector<CloseUp> place_close_ups(const VideoOptions& options, const SceneDrawing& scene,
                                     const Style& style, double legend_height);

}  // namespace ghtrack::render

#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/stage.hpp"

namespace ghtrack::render {

/// A round speed that the arrows of this scene can show [m/s]: for the legend.
double round_wind(const SceneDrawing& scene);

/// How long an arrow for a wind of that speed is [px].
double wind_arrow_length(double speed, const SceneDrawing& scene, const Style& style);

/// Draws arrows along the wind on a grid that stands still in the world, above the ground.
void draw_wind(Canvas& canvas, const Stage& stage, double time);

}  // namespace ghtrack::render

#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"

namespace ghtrack::render {

/// The kinds of true objects a picture has shown, for its legend.
struct ShapesShown {
  bool box = false;
  bool disc = false;
  bool balloon = false;
  bool drone = false;
};

/// Draws the true objects: cars as rotated boxes, balls as discs with a mark that spins, balloons
/// with a string, drones with rotors. Small ones are drawn larger than they are, so that they stay visible.
ShapesShown draw_truth(Canvas& canvas, const View& view, const SceneDrawing& scene,
                       const TruthSnapshot& truth, const Style& style);

/// Half the size at which an object is drawn [px].
double drawn_radius(const Outline& outline, const View& view, const Style& style);

/// Boxes around all that draw_truth() draws, for labels to avoid.
std::vector<Viewport> drawn_bodies(const View& view, const SceneDrawing& scene,
                                   const TruthSnapshot& truth, const Style& style);

/// Draws arrows along the wind; the longest ones show `reference` [m/s].
void draw_wind(Canvas& canvas, const View& view, const std::vector<WindSample>& wind,
               double reference, const Style& style);

}  // namespace ghtrack::render

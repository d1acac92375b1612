#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/stage.hpp"

namespace ghtrack::render {

/// Draws the true objects: cars as rotated boxes, balls as discs with a mark that spins, balloons
/// with a string, drones with rotors. Small ones are drawn larger than they are, so that they stay
/// visible.
void draw_truth(Canvas& canvas, const Stage& stage, const TruthSnapshot& truth);

/// Half the size at which an object is drawn [px].
double drawn_radius(const Outline& outline, const View& view, const Style& style);

/// Boxes around all that draw_truth() draws, for labels to avoid.
std::vector<Viewport> drawn_bodies(const View& view, const SceneDrawing& scene,
                                   const TruthSnapshot& truth, const Style& style);

}  // namespace ghtrack::render

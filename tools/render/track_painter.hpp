#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/stage.hpp"
#include "tools/render/track_memory.hpp"

namespace ghtrack::render {

/// Radius of the ring around an estimate [px of a picture with 1280 × 720].
inline constexpr double kEstimateRing = 10.0;

/// Draws what a tracker says at the time of a frame, all but the labels.
void draw_tracks(Canvas& canvas, const Stage& stage, const TrackMemory& memory,
                 const VideoFrame& frame, const PanelFrame& panel);

/// Draws the paths as they are known afterwards, up to the time of a frame [s], as far back as
/// trails reach.
void draw_smoothed(Canvas& canvas, const Stage& stage, const TrackMemory& memory,
                   const SmoothedPaths& paths, double time);

}  // namespace ghtrack::render

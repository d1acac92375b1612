#pragma once

#include "tools/render/canvas.hpp"
#include "tools/render/label_layout.hpp"
#include "tools/render/stage.hpp"
#include "tools/render/track_memory.hpp"

namespace ghtrack::render {

/// Writes what tracks and true objects are called, where it hides least.
class TrackLabels {
 public:
  /// @param canvas    null: labels take their places, on which the next ones depend, unseen
  /// @param keep_out  parts of the picture that belong to something else
  void draw(Canvas* canvas, const Stage& stage, const TrackMemory& memory, const VideoFrame& frame,
            const std::vector<Viewport>& keep_out);

 private:
  LabelLayout layout_;
};

}  // namespace ghtrack::render

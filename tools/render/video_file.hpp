#pragma once

#include <memory>

#include "tools/render/module.hpp"

namespace ghtrack::render {

/// Draws, encodes and verifies a video; see VideoWriter.
std::unique_ptr<VideoSink> open_video_file(const VideoOptions& options, const SceneDrawing& scene);

}  // namespace ghtrack::render

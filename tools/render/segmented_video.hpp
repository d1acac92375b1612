#pragma once

#include <memory>

#include "tools/render/module.hpp"

namespace ghtrack::render {

/// Draws, encodes and verifies an MP4 video, several pieces of it at a time; see VideoWriter and
/// H264Segment.
std::unique_ptr<VideoSink> open_segmented_video(const VideoOptions& options,
                                                const SceneDrawing& scene);

}  // namespace ghtrack::render

#pragma once

#include "tools/cli/commands.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::cli {

/// Changes what a video shows.
/// @throws UsageError for a size that cannot be read, or a layer that there is not
void apply(const VideoLook& look, render::VideoOptions& video);

}  // namespace ghtrack::cli

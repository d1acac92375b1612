#pragma once

#include <filesystem>
#include <memory>

#include "tools/render/footage.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::render {

/// The far side of a VideoWriter.
class VideoSink {
 public:
  virtual ~VideoSink() = default;
  virtual void add_frame(const VideoFrame& frame) = 0;
  virtual void remember(const VideoFrame& frame) = 0;
  virtual void write_poster(const std::filesystem::path& path) = 0;
  virtual void finish() = 0;
  virtual void keep_partial() = 0;
};

/// What the loadable module `ghtrack_render.so` offers: OpenCV's drawing. OpenCV's files lie behind
/// another (codecs.hpp), because few videos need them.
class RenderModule {
 public:
  virtual ~RenderModule() = default;
  virtual std::unique_ptr<VideoSink> open_video(const VideoOptions& options,
                                                const SceneDrawing& scene) = 0;
  virtual std::unique_ptr<FootageSink> open_footage(const FootageOptions& options) = 0;
};

/// Name and type of the module's only symbol.
inline constexpr const char* kRenderModuleFactory = "ghtrack_render_module";
using RenderModuleFactory = RenderModule* (*)();  // the one instance; lives as long as the program

/// The module, loaded at the first call from `lib/ghtrack` next to the folder of the running
/// program or one of its parents: the installed tree and the build tree look alike.
/// @throws OutputError naming the places where it was looked for
RenderModule& render_module();

}  // namespace ghtrack::render

#include "tools/render/footage_file.hpp"
#include "tools/render/module.hpp"
#include "tools/render/video_file.hpp"

namespace ghtrack::render {

namespace {

class OpenCvModule : public RenderModule {
 public:
  std::unique_ptr<VideoSink> open_video(const VideoOptions& options,
                                        const SceneDrawing& scene) override {
    return open_video_file(options, scene);
  }

  std::unique_ptr<FootageSink> open_footage(const FootageOptions& options) override {
    return open_footage_file(options);
  }
};

}  // namespace

}  // namespace ghtrack::render

extern "C" ghtrack::render::RenderModule* ghtrack_render_module() {
  static ghtrack::render::OpenCvModule module;
  return &module;
}

#include "tools/render/video_file.hpp"

#include "tools/render/encoded_file.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/segmented_video.hpp"

namespace ghtrack::render {

namespace {

class VideoFile : public VideoSink {
 public:
  VideoFile(const VideoOptions& options, const SceneDrawing& scene)
      : file_(options), picture_(options, scene) {}

  void add_frame(const VideoFrame& frame) override { picture_.draw(frame, file_.next_image()); }
  void remember(const VideoFrame& frame) override { picture_.remember(frame); }
  void write_poster(const std::filesystem::path& path) override { file_.write_poster(path); }
  void finish() override { file_.finish(); }
  void keep_partial() override { file_.keep_partial(); }

 private:
  EncodedFile file_;
  Picture picture_;
};

}  // namespace

std::unique_ptr<VideoSink> open_video_file(const VideoOptions& options, const SceneDrawing& scene) {
  if (is_made_in_segments(options)) return open_segmented_video(options, scene);
  return std::make_unique<VideoFile>(options, scene);
}

}  // namespace ghtrack::render

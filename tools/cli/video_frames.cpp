#include "tools/cli/video_frames.hpp"

#include <utility>

#include "tools/cli/interruption.hpp"
#include "tools/film/scene_drawing.hpp"

namespace ghtrack::cli {
namespace {

std::vector<render::PanelDrawing> panels_of(const std::vector<film::Contender>& contenders) {
  std::vector<render::PanelDrawing> panels;
  for (const film::Contender& contender : contenders) panels.push_back(contender.drawing());
  return panels;
}

}  // namespace

VideoFrames::VideoFrames(const WorldScene& scene, const World& world,
                         const render::VideoOptions& options,
                         std::vector<film::Contender> contenders, bool quiet)
    : times_(render::frame_times(options, scene.duration)),
      writer_(options, film::drawing_of(scene, world, panels_of(contenders), stop_if_interrupted)),
      maker_(scene, std::move(contenders)),
      progress_("video", "frames", times_.size(), quiet) {}

void VideoFrames::add_frame(const TruthSnapshot& truth) {
  writer_.add_frame(maker_.frame(truth));
  progress_.advance();
}

}  // namespace ghtrack::cli

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"
#include "tools/cli/contenders.hpp"
#include "tools/cli/progress.hpp"
#include "tools/record/step_record.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::cli {

/// How a scene wants to be drawn, before options change it.
render::VideoOptions video_options(const WorldScene& scene, const World& world,
                                   const std::filesystem::path& path);

/// Turns a run into a video: remembers what the tracker knew and draws it at each frame's time.
class VideoFrames {
 public:
  /// @param world       of the run; must outlive this
  /// @param contenders  shown side by side instead of the scene's own tracker; empty: none
  VideoFrames(const WorldScene& scene, const World& world, const render::VideoOptions& options,
              std::vector<Contender> contenders, bool quiet);

  /// Scene times of all frames [s].
  const std::vector<double>& times() const { return times_; }

  void add_scan(const StepRecord& record);
  void add_late_scan(const Observation& observation);
  void add_frame(const TruthSnapshot& truth);
  render::VideoWriter& writer() { return writer_; }

 private:
  VideoFrames(const World& world, const render::VideoOptions& options,
              std::vector<Contender> contenders, const render::SceneDrawing& drawing,
              double duration, bool quiet);

  const World& world_;
  std::vector<Contender> contenders_;
  render::VideoWriter writer_;
  std::vector<double> times_;
  std::map<int, Observation> latest_;  // by sensor
  render::VideoFrame frame_;
  Progress progress_;
};

}  // namespace ghtrack::cli

#pragma once

#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/video_place.hpp"
#include "tools/film/contender.hpp"
#include "tools/film/frame_maker.hpp"
#include "tools/record/step_record.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::cli {

/// Turns a run into a video.
class VideoFrames {
 public:
  /// @param world       of the run; must outlive this
  /// @param contenders  shown side by side instead of the scene's own tracker; empty: none
  VideoFrames(const WorldScene& scene, const World& world, const render::VideoOptions& options,
              std::vector<film::Contender> contenders, bool quiet);

  /// Scene times of all frames [s].
  const std::vector<double>& times() const { return times_; }

  void add_scan(const StepRecord& record) { maker_.add_scan(record); }
  void add_late_scan(const Observation& observation) { maker_.add_late_scan(observation); }
  void add_frame(const TruthSnapshot& truth);
  render::VideoWriter& writer() { return writer_; }

 private:
  std::vector<double> times_;
  render::VideoWriter writer_;
  film::FrameMaker maker_;
  Progress progress_;
};

/// Runs a scene from its start to its end into a video, which finish() has still to complete. What
/// an interrupted run has drawn is kept in a file named .partial.
void film_run(const WorldScene& scene, World& world, VideoFrames& frames, VideoPlace& place);

}  // namespace ghtrack::cli

#pragma once

#include <map>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/film/contender.hpp"
#include "tools/film/running_score.hpp"
#include "tools/record/step_record.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::film {

/// Remembers what sensors and trackers said last, and puts it beside the truth of a frame's time:
/// estimates are shown as they were known then.
class FrameMaker {
 public:
  /// @param contenders  shown side by side instead of the scene's own tracker; empty: none
  FrameMaker(const WorldScene& scene, std::vector<Contender> contenders);

  void add_scan(const StepRecord& record);
  void add_late_scan(const Observation& observation);

  /// The frame of the truth's instant; valid until the next call.
  const render::VideoFrame& frame(const TruthSnapshot& truth);

 private:
  std::vector<Contender> contenders_;
  RunningScore score_;                 // of the scene's own tracker
  std::map<int, Observation> latest_;  // by sensor
  render::VideoFrame frame_;
};

}  // namespace ghtrack::film

#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/film/running_score.hpp"
#include "tools/record/run_observer.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::film {

/// Which contenders of a run are shown, side by side if there are several.
struct Shown {
  std::size_t first = 0;
  std::size_t count = 1;
};

/// Remembers what sensors and trackers said last, and puts it beside the truth of a frame's time:
/// estimates are shown as they were known then.
class FrameMaker final : public RunObserver {
 public:
  using OnFrame = std::function<void(const render::VideoFrame&)>;

  FrameMaker(const WorldScene& scene, const std::vector<ObjectInfo>& objects, const Shown& shown,
             OnFrame on_frame);

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override;
  void add_tracks(const StepRecord& record) override;
  void add_frame(const TruthSnapshot& truth) override;

 private:
  Shown shown_;
  OnFrame on_frame_;
  std::vector<RunningScore> scores_;   // of those shown
  std::map<int, Observation> latest_;  // by sensor
  render::VideoFrame frame_;
};

}  // namespace ghtrack::film

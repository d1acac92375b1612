#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"
#include "tools/film/frame_maker.hpp"
#include "tools/record/run_observer.hpp"
#include "tools/render/video.hpp"
#include "tools/run/contender.hpp"
#include "tools/run/truth_source.hpp"

namespace ghtrack::film {

/// Makes a video of the run that it listens to.
class Film final : public RunObserver {
 public:
  /// @param make_world  makes the world of the run at its start
  /// @param contenders  of the run
  /// @param shown       those of them that are shown
  /// @param on_step     called now and then; may throw to give up
  Film(const WorldScene& scene, std::function<World()> make_world,
       const render::VideoOptions& options, std::span<const Contender> contenders,
       const Shown& shown, const std::function<void()>& on_step);

  /// The truth of the run at its start. A picture that is to hold everything needs the truth twice,
  /// so it has been simulated and recorded already, if it fits into memory.
  TruthSource& truth() { return *truth_; }

  /// Scene times of all frames, and before them of those that pictures only remember [s].
  const std::vector<double>& frame_times() const { return times_; }

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override {
    frames_.add_observation(truth, observation);
  }
  void add_tracks(const StepRecord& record) override { frames_.add_tracks(record); }
  void add_frame(const TruthSnapshot& truth) override { frames_.add_frame(truth); }

  render::VideoWriter& writer() { return writer_; }

 private:
  render::SceneDrawing drawing(const WorldScene& scene, const render::VideoOptions& options,
                               std::span<const Contender> contenders, const Shown& shown,
                               const std::function<void()>& on_step) const;
  void show(const render::VideoFrame& frame);

  double from_;  // [s] of the first frame that is shown
  std::vector<double> times_;
  World world_;  // stays at its start: only its wind is asked for
  std::unique_ptr<TruthSource> truth_;
  render::VideoWriter writer_;
  FrameMaker frames_;
};

}  // namespace ghtrack::film

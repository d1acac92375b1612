#include "tools/film/film.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <set>
#include <utility>

#include "tools/film/scene_drawing.hpp"
#include "tools/metrics/output.hpp"
#include "tools/run/run.hpp"
#include "tools/run/schedule.hpp"
#include "tools/run/track_history.hpp"

namespace ghtrack::film {
namespace {

/// What several contenders side by side are called; one alone needs no name.
std::vector<render::PanelDrawing> panels_of(std::span<const Contender> contenders,
                                            const Shown& shown) {
  std::vector<render::PanelDrawing> panels;
  if (shown.count == 1) return panels;
  for (const Contender& contender : contenders.subspan(shown.first, shown.count)) {
    panels.push_back(panel_of(contender));
  }
  return panels;
}

std::vector<double> merged(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

/// Recorded unless it is gone through only once.
std::unique_ptr<TruthSource> truth_of(const WorldScene& scene, std::function<World()> make_world,
                                      const std::vector<double>& frame_times,
                                      const std::function<void()>& on_step) {
  if (!needs_extent(scene)) return std::make_unique<SimulatedTruth>(std::move(make_world));
  const std::vector<double> shown = merged(frame_times, extent_instants(scene.duration));
  return repeatable_truth(std::move(make_world), merged(scan_instants(scene), shown), on_step);
}

/// Runs the scene once before, for where the tracks of those shown were as is known at its end.
std::vector<render::SmoothedPaths> smoothed_paths(const WorldScene& scene, TruthSource& truth,
                                                  std::span<const Contender> contenders,
                                                  const std::function<void()>& on_step) {
  /// Asks whether to give up.
  struct Pulse final : RunObserver {
    explicit Pulse(const std::function<void()>& on_step) : beat(on_step) {}
    void add_tracks(const StepRecord& /*record*/) override { beat(); }
    const std::function<void()>& beat;
  };
  Pulse pulse(on_step);
  std::deque<HistoryObserver> histories;
  RunObservers observers = {&pulse};
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    observers.push_back(&histories.emplace_back(contenders[i].tracker.design(), i));
  }
  truth.restart();
  run(scene, truth, contenders, observers);
  std::vector<render::SmoothedPaths> all;
  for (const HistoryObserver& observer : histories) {
    render::SmoothedPaths& paths = all.emplace_back();
    std::set<int> confirmed;
    for (const SmoothedSnapshot& now : observer.history().smoothed()) {
      for (std::size_t i = 0; i < now.smoothed.size(); ++i) {
        const TrackEstimate& track = now.tracks.tracks[i];
        if (counts_as_output(track)) confirmed.insert(track.id);
        paths[track.id].emplace_back(now.tracks.time, now.smoothed[i].state.position);
      }
    }
    std::erase_if(paths, [&](const auto& path) { return !confirmed.contains(path.first); });
  }
  return all;
}

render::VideoWriter writer_of(const WorldScene& scene, render::VideoOptions options,
                              render::SceneDrawing drawing, TruthSource& truth,
                              const std::function<void()>& on_step) {
  magnify_small_errors(scene, truth, on_step, drawing, options);
  return {options, drawing};
}

}  // namespace

Film::Film(const WorldScene& scene, std::function<World()> make_world,
           const render::VideoOptions& options, std::span<const Contender> contenders,
           const Shown& shown, const std::function<void()>& on_step)
    : from_(options.from),
      times_(merged(render::times_before(options), render::frame_times(options, scene.duration))),
      world_(make_world()),
      truth_(truth_of(scene, std::move(make_world), times_, on_step)),
      writer_(writer_of(scene, options, drawing(scene, options, contenders, shown, on_step),
                        *truth_, on_step)),
      frames_(scene, world_.objects(), shown,
              [this](const render::VideoFrame& frame) { show(frame); }) {
  truth_->restart();
}

render::SceneDrawing Film::drawing(const WorldScene& scene, const render::VideoOptions& options,
                                   std::span<const Contender> contenders, const Shown& shown,
                                   const std::function<void()>& on_step) const {
  render::SceneDrawing drawing =
      drawing_of(scene, world_, *truth_, panels_of(contenders, shown), on_step);
  if (options.layers.shows(render::Layer::kSmoothed)) {
    drawing.smoothed =
        smoothed_paths(scene, *truth_, contenders.subspan(shown.first, shown.count), on_step);
  }
  return drawing;
}

void Film::show(const render::VideoFrame& frame) {
  if (frame.time < from_) {
    writer_.remember(frame);
  } else {
    writer_.add_frame(frame);
  }
}

}  // namespace ghtrack::film

#include "tools/film/frame_maker.hpp"

#include <utility>

#include "sensors/sensor.hpp"
#include "tools/metrics/run_metrics.hpp"

namespace ghtrack::film {

FrameMaker::FrameMaker(const WorldScene& scene, const std::vector<ObjectInfo>& objects,
                       const Shown& shown, OnFrame on_frame)
    : shown_(shown),
      on_frame_(std::move(on_frame)),
      scores_(shown.count, RunningScore(scoring_for(traits_of(scene.sensors)).gospa(), objects)) {
  frame_.panels.resize(shown.count);
}

void FrameMaker::add_observation(const TruthSnapshot& truth, const Observation& /*observation*/) {
  frame_.passed.push_back({.time = truth.time, .objects = truth.objects, .bodies = {}});
}

void FrameMaker::add_tracks(const StepRecord& record) {
  if (record.contender == 0) {
    latest_[record.observation.scan.sensor] = record.observation;
    frame_.arrived.push_back(record.observation);
    ++frame_.scans;
  }
  const std::size_t panel = record.contender - shown_.first;
  if (panel >= shown_.count) return;  // also before the first: the difference wraps around
  RunningScore& score = scores_[panel];
  if (record.is_in_order()) score.add(record.truth, record.tracks);
  render::PanelFrame& shown = frame_.panels[panel];
  shown.arrived.push_back({record.tracks, score.pairings(), score.rmse()});
  shown.tracks = record.tracks;
  shown.gospa = score.gospa();
  shown.rmse = score.rmse();
  shown.missed = score.missed();
  shown.regimes = score.by_regime();
}

void FrameMaker::add_frame(const TruthSnapshot& truth) {
  frame_.time = truth.time;
  frame_.truth = truth;
  frame_.observations.clear();
  for (const auto& [sensor, observation] : latest_) frame_.observations.push_back(observation);
  on_frame_(frame_);
  frame_.arrived.clear();
  frame_.passed.clear();
  for (render::PanelFrame& panel : frame_.panels) panel.arrived.clear();
}

}  // namespace ghtrack::film

#include "tools/film/frame_maker.hpp"

#include <utility>

#include "sensors/sensor.hpp"
#include "tools/metrics/run_metrics.hpp"

namespace ghtrack::film {

FrameMaker::FrameMaker(const WorldScene& scene, std::vector<Contender> contenders)
    : contenders_(std::move(contenders)), score_(scoring_for(traits_of(scene.sensors)).gospa()) {
  frame_.panels.resize(1);
}

void FrameMaker::add_scan(const StepRecord& record) {
  latest_[record.observation.scan.sensor] = record.observation;
  if (contenders_.empty()) {
    score_.add(record.truth, record.tracks);
    frame_.panels.front() = {.tracks = record.tracks,
                             .pairings = score_.pairings(),
                             .gospa = score_.gospa(),
                             .rmse = score_.rmse()};
  }
  for (Contender& contender : contenders_) {
    contender.add(record.observation);
    contender.score(record.truth);
  }
  ++frame_.scans;
}

void FrameMaker::add_late_scan(const Observation& observation) {
  latest_[observation.scan.sensor] = observation;
  for (Contender& contender : contenders_) contender.add(observation);
  ++frame_.scans;
}

const render::VideoFrame& FrameMaker::frame(const TruthSnapshot& truth) {
  frame_.time = truth.time;
  frame_.truth = truth;
  if (!contenders_.empty()) {
    frame_.panels.clear();
    for (const Contender& contender : contenders_) frame_.panels.push_back(contender.frame());
  }
  frame_.observations.clear();
  for (const auto& [sensor, observation] : latest_) frame_.observations.push_back(observation);
  return frame_;
}

}  // namespace ghtrack::film

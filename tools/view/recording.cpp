#include "tools/view/recording.hpp"

#include <algorithm>

#include "tools/pipeline/simulation.hpp"

namespace ghtrack::view {

Recording record(const WorldScene& scene, const std::vector<double>& frame_times) {
  Recording recording;
  World world = make_world(scene);
  Listener listener;
  listener.on_observation = [&](const TruthSnapshot& truth, const Observation& observation) {
    const auto& sensor = scene.sensors[static_cast<std::size_t>(observation.scan.sensor)];
    recording.arrivals.push_back({observation.scan.time + sensor.latency, truth, observation});
  };
  listener.on_scan = [](const StepRecord&) {};
  listener.frame_times = frame_times;
  listener.on_frame = [&](const TruthSnapshot& truth) { recording.frames.push_back(truth); };
  run(scene, world, listener);
  std::stable_sort(recording.arrivals.begin(), recording.arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.time < b.time; });
  return recording;
}

}  // namespace ghtrack::view

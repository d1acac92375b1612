#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "tools/experiment/engine.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/run/run.hpp"
#include "tools/run/schedule.hpp"

// What a run, and a run of a campaign, cost beside the simulation of their truth. All parts take
// turns, so that a busy machine slows them alike, and the least time of each counts.

namespace ghtrack::bench {
namespace {

template <class Work>
double seconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The scene with its own tracker alone.
WorldScene three_regimes(int runs) {
  const std::string file = std::string(GHTRACK_SOURCE_DIR) + "/scenes/three_regimes.yaml";
  WorldScene scene = std::get<WorldScene>(read_scene(file));
  scene.compare.filters.clear();
  scene.compare.order.clear();
  scene.compare.runs = runs;
  return scene;
}

void simulate_truth(const WorldScene& scene) {
  World world = make_world(scene);
  for (const double time : scan_instants(scene)) benchmark::DoNotOptimize(world.sample(time));
}

/// World, sensors, tracker and metrics, as `ghtrack run` does without files.
void run_headless(const WorldScene& scene) {
  SimulatedTruth truth([&] { return make_world(scene); });
  RunMetrics metrics(truth.objects(), scoring_for(traits_of(scene.sensors)));
  run(scene, truth, std::vector{own_tracker(scene)}, {&metrics});
  benchmark::DoNotOptimize(metrics.report());
}

void run_beside_truth(benchmark::State& state) {
  const WorldScene scene = three_regimes(1);
  const Trial trial(scene);
  double truth = 1e9;
  double whole = 1e9;
  double replay = 1e9;
  int seed = 0;
  for (auto _ : state) {
    truth = std::min(truth, seconds([&] { simulate_truth(scene); }));
    whole = std::min(whole, seconds([&] { run_headless(scene); }));
    replay = std::min(replay, seconds([&] { benchmark::DoNotOptimize(trial.scores(++seed)); }));
  }
  state.counters["truth_ms"] = 1e3 * truth;
  state.counters["run/truth"] = whole / truth;
  state.counters["replay/truth"] = replay / truth;
}
BENCHMARK(run_beside_truth)->Name("three_regimes/run")->Unit(benchmark::kMillisecond);

void compute_all(const Campaign& campaign, int jobs) {
  compute(
      campaign, groups_by_truth(campaign), Shard{}, RunSet(campaign), jobs, [] {},
      [](std::size_t, int, std::vector<double> scores) { benchmark::DoNotOptimize(scores); });
}

/// Each run simulates a truth of its own, so that there is nothing to wait for.
void two_threads(benchmark::State& state) {
  WorldScene scene = three_regimes(16);
  scene.compare.fresh_wind = true;
  const Campaign campaign{{{scene, "three_regimes.yaml", ""}}};
  double one = 1e9;
  double two = 1e9;
  for (auto _ : state) {
    one = std::min(one, seconds([&] { compute_all(campaign, 1); }));
    two = std::min(two, seconds([&] { compute_all(campaign, 2); }));
  }
  state.counters["runs/s"] = campaign.cells[0].runs() / one;
  state.counters["speed-up"] = one / two;
}
BENCHMARK(two_threads)
    ->Name("three_regimes/two_threads")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace ghtrack::bench

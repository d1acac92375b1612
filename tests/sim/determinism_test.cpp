#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <future>
#include <string>
#include <variant>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "tests/sim/golden_worlds.hpp"
#include "tests/sim/scenario.hpp"
#include "tests/tools/run/listener.hpp"
#include "tools/run/run.hpp"

// T20: the truth depends on the scene and its seed, and on nothing else.

namespace ghtrack {
namespace {

// Recorded: every equation of motion, every draw of the wind and every collision, on x86-64 with
// Debian's Box2D 2.4.1. tools/check_determinism shows that gcc -O0, -O2, -O3 and clang -O0, -O2
// give the same. After an intended change, take the values from the failures' messages.
TEST(Truth, HasTheSameBitsForEver) {
  EXPECT_EQ(truth_hash(busy_world(), 4.0, 30.0), 5209068621676727165u);
  EXPECT_EQ(truth_hash(stormy_world(), 6.0, 30.0), 14794729309441318197u);
}

// Property: sampling is a question, not a force.
TEST(Truth, IsTheSameWhateverTheInstantsOfSampling) {
  for (const WorldConfig& config : {busy_world(), stormy_world()}) {
    World seldom(config, 7);
    const TruthSnapshot once = seldom.sample(4.0);
    World often(config, 7);
    for (int i = 0; i < 4 * 97; ++i) often.sample(i / 97.0);
    EXPECT_EQ(truth_hash(often.sample(4.0)), truth_hash(once));
  }
}

// Property: another seed is another wind; the same seed is the same.
TEST(Truth, DependsOnItsSeed) {
  const WorldConfig config = busy_world();
  const std::uint64_t first = truth_hash(World(config, 7).sample(1.0));
  EXPECT_EQ(truth_hash(World(config, 7).sample(1.0)), first);
  EXPECT_NE(truth_hash(World(config, 8).sample(1.0)), first);
}

double largest_change_at_half_the_step(WorldConfig config) {
  World coarse(config, 7);
  config.physics.rate *= 2.0;
  World fine(config, 7);
  double largest = 0.0;
  for (int i = 0; i <= 60; ++i) {
    const TruthSnapshot a = coarse.sample(0.1 * i);
    const TruthSnapshot b = fine.sample(0.1 * i);
    for (std::size_t k = 0; k < a.objects.size(); ++k) {
      largest = std::max(largest, (a.objects[k].position - b.objects[k].position).norm());
    }
  }
  return largest;
}

// Property: the order of convergence leaves room: halving the step moves nothing by as much as the
// tightest tolerance of the reference trajectories, 1 mm. Objects that hit each other are left out:
// a collision multiplies any difference.
TEST(Truth, ChangesLittleWhenThePhysicsStepIsHalved) {
  WorldConfig calm = busy_world();
  calm.targets.erase(calm.targets.begin() + 3, calm.targets.end());
  EXPECT_LT(largest_change_at_half_the_step(calm), 1e-3);
  EXPECT_LT(largest_change_at_half_the_step(stormy_world()), 1e-3);
}

constexpr const char* kScene = R"(
name: scene
duration: 3
seed: 5
world:
  ground: {height: 0}
  wind: {mean: [6, 0], turbulence: {model: dryden, intensity: 0.2}}
targets:
  - train: {position: [0, 30], speed: 12, drive: [{at: 1, brake: service}]}
  - ball: {position: [0, 1], velocity: [9, 6], spin_rpm: 900}
  - ball: {position: [14, 1], velocity: [-5, 6]}
  - balloon: {position: [5, 5]}
sensors:
  - {name: first, rate: 20}
)";

WorldScene scene_with(const std::vector<std::string>& overrides) {
  return std::get<WorldScene>(read_scene_text(kScene, "scene", overrides));
}

/// Hash of the truth at the scans of the first sensor.
std::uint64_t truth_hash_of_run(const WorldScene& scene,
                                const std::vector<double>& frame_times = {}) {
  SimulatedTruth source([&] { return make_world(scene); });
  std::uint64_t hash = 0;
  Listener listener;
  listener.on_observation = [&](const TruthSnapshot& truth, const Observation& observation) {
    if (observation.scan.sensor == 0) hash = truth_hash(truth, hash);
  };
  run(scene, source, std::vector{own_tracker(scene)}, {&listener}, frame_times);
  return hash;
}

// Property: who looks, how well, what is made of it and whether it is filmed have no influence.
TEST(Truth, DoesNotDependOnSensorsFiltersAndPictures) {
  const std::uint64_t wanted = truth_hash_of_run(scene_with({}));
  EXPECT_EQ(truth_hash_of_run(scene_with({"sensors[first].noise=3", "sensors[first].clutter=0",
                                          "sensors[first].detection_probability=0.3"})),
            wanted);
  EXPECT_EQ(truth_hash_of_run(
                scene_with({"sensors=[{name: first, rate: 20}, {name: second, rate: 33.3}]"})),
            wanted);
  EXPECT_EQ(truth_hash_of_run(scene_with({"tracker={filters: {default: {gh: {g: 0.9, h: 0.4}}}}"})),
            wanted);
  EXPECT_EQ(truth_hash_of_run(scene_with({}), {0.011, 0.5, 0.77, 1.23456, 2.9}), wanted);
  EXPECT_NE(truth_hash_of_run(scene_with({"seed=6"})), wanted);
}

// Property: worlds share nothing: as many at once as one likes give what one alone gives.
TEST(Truth, DoesNotDependOnTheNumberOfThreads) {
  const WorldScene scene = scene_with({});
  const std::uint64_t wanted = truth_hash_of_run(scene);
  std::vector<std::future<std::uint64_t>> runs;
  for (int i = 0; i < 8; ++i) {
    runs.push_back(std::async(std::launch::async, [&] { return truth_hash_of_run(scene); }));
  }
  for (std::future<std::uint64_t>& run : runs) EXPECT_EQ(run.get(), wanted);
}

}  // namespace
}  // namespace ghtrack

#include "tools/experiment/trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/experiment/sample_campaign.hpp"
#include "tools/run/run.hpp"

namespace ghtrack {
namespace {

using ::testing::NanSensitiveDoubleEq;
using ::testing::Pointwise;

/// Balls and a train under two sensors, one of them late, with clutter and misses.
WorldScene busy_scene(const std::string& compare) {
  const std::string text = R"(
name: busy
seed: 21
duration: 5
world: {wind: {mean: [3, 0], turbulence: {model: dryden, intensity: 0.3}}, ground: {height: 0}}
targets:
  - {name: fly, ball: {type: baseball, position: [0, 1], velocity: [18, 20]}}
  - {name: lob, appears: 1, ball: {type: tennis, position: [50, 1], velocity: [-9, 15]}}
  - {name: tram, train: {cars: 2, position: [0, 1.5], track: [{straight: 200}], speed: 6}}
sensors:
  - {name: camera, rate: 10, noise: 0.4, detection_probability: 0.9, clutter: 1,
     field_of_view: [[-20, -5], [90, 60]]}
  - {name: post, rate: 3, phase: 0.02, latency: 0.2, noise: 0.8}
tracker: {late_scans: replay, filters: {default: {ghk: {design: tracking-index, process_noise: 10}}}}
compare: )" + compare + "\n";
  return std::get<WorldScene>(read_scene_text(text, "busy.yaml"));
}

// Property: the scores of a run are those of `ghtrack run` with its seed on the same world, to the
// last bit.
TEST(Trial, ScoresAsARunDoes) {
  const WorldScene scene = busy_scene("{runs: 5}");
  const Trial trial(scene);
  const std::vector<double> scores = trial.scores(3);

  SimulatedTruth truth([&] { return make_world(scene); });
  RunMetrics metrics(truth.objects(), trial.scoring());
  run(scene_of_run(scene, 3), truth, std::vector{own_tracker(scene)}, {&metrics});
  const RunReport report = metrics.report();

  const TrialLayout layout = trial.layout();
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(trial.subjects()[i].object, report.objects[i].name);
    EXPECT_EQ(scores[layout.value(0, i, Metric::kRmsePosition)], *report.objects[i].rmse_position);
    EXPECT_EQ(scores[layout.value(0, i, Metric::kPeakError)], *report.objects[i].peak_error);
  }
  const std::size_t whole = trial.subjects().size() - 1;
  EXPECT_EQ(scores[layout.value(0, whole, Metric::kGospa)], report.total.gospa);
  EXPECT_NEAR(scores[layout.value(0, whole, Metric::kRmsePosition)], *report.total.rmse_position,
              1e-12);
}

// Property: truth that was recorded once gives the bits of truth that is simulated for each run.
TEST(Trial, ReplaysRecordedTruth) {
  const WorldScene scene = busy_scene("{runs: 5}");
  const Trial trial(scene);
  SimulatedTruth fresh([&] { return world_of_run(scene, 2); });
  EXPECT_THAT(trial.scores(2), Pointwise(NanSensitiveDoubleEq(), trial.scores(2, fresh, {})));
}

/// The numbers of one contender.
std::vector<double> scores_of(const Trial& trial, const std::string& name, int run) {
  const std::vector<double> scores = trial.scores(run);
  const std::size_t each = scores.size() / trial.contenders().size();
  for (std::size_t i = 0; i < trial.contenders().size(); ++i) {
    if (trial.contenders()[i].name != name) continue;
    const auto first = scores.begin() + static_cast<std::ptrdiff_t>(i * each);
    return {first, first + static_cast<std::ptrdiff_t>(each)};
  }
  return {};
}

// Property: who else is compared changes nothing for a filter.
TEST(Trial, JudgesEveryFilterAlone) {
  const Trial two(busy_scene("{filters: {b: {gh: {g: 0.5, h: 0.2}}, d: {gh: {g: 0.2, h: 0.02}}}}"));
  const Trial three(
      busy_scene("{filters: {a: {gh: {g: 0.9, h: 0.5}}, b: {gh: {g: 0.5, h: 0.2}}, "
                 "c: {kalman-ca: {process_noise: 5}}}}"));
  EXPECT_THAT(scores_of(three, "b", 1), Pointwise(NanSensitiveDoubleEq(), scores_of(two, "b", 1)));
}

// Property: an exception from the callback ends a run.
TEST(Trial, GivesUpWhenAskedTo) {
  int scans = 0;
  const Trial trial(busy_scene("{runs: 5}"), [&] {
    if (++scans == 7) throw std::runtime_error("enough");
  });
  EXPECT_THROW(trial.scores(0), std::runtime_error);
  EXPECT_EQ(scans, 7);
}

// Property: objects of large swarms are judged together, not one by one.
TEST(Trial, ListsObjectsOnlyIfTheyAreFew) {
  WorldScene scene = busy_scene("{runs: 1}");
  scene.targets[0].repeat = Repeat{.count = 60, .every = 0.0, .shift = Vec2(0.0, 3.0)};
  const Trial trial(scene);
  ASSERT_EQ(trial.subjects().size(), 3U);
  EXPECT_EQ(trial.subjects()[0].regime, "ball");
  EXPECT_EQ(trial.subjects()[0].objects.size(), 61U);
  EXPECT_EQ(trial.subjects()[2].regime, "");
}

}  // namespace
}  // namespace ghtrack

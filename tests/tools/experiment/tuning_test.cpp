#include "tools/experiment/tuning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/tools/experiment/sample_campaign.hpp"

namespace ghtrack {
namespace {

using ::testing::HasSubstr;
using testing::steady_scene;

const JudgedGains& judged(const TunedRegime& regime, const std::string& origin) {
  for (const JudgedGains& gains : regime.judged) {
    if (gains.origin == origin) return gains;
  }
  throw std::runtime_error("nothing of that origin");
}

// Property: on unseen seeds tuned gains are not worse than gains by rule or by hand by more than
// the interval of the difference, and close to the bound for motion at constant velocity.
TEST(Tune, BeatsDesignsAndGuesses) {
  const WorldScene scene =
      steady_scene("{filters: {guess: {gh: {g: 0.3, h: 0.05}}, wild: {gh: {g: 0.9, h: 0.8}}}}");
  const Tuning tuning = tune(scene, {.runs = 20, .orders = {1}, .rule = {}, .jobs = 2});
  const TunedRegime& ball = tuning.regimes.at(0);
  EXPECT_EQ(ball.regime, "ball");
  for (const JudgedGains& other : ball.judged) {
    if (other.origin == "tuned") continue;
    EXPECT_GE(other.difference_ci95->high, 0.0) << other.origin;
  }
  EXPECT_GT(judged(ball, "wild").difference_ci95->low, 0.0);
  EXPECT_LT(judged(ball, "tuned").rmse, 1.05 * *ball.bound);
}

// Property: the same gains for any number of threads, and again.
TEST(Tune, IsDeterministic) {
  const WorldScene scene = steady_scene("{runs: 3}");
  const TuningOptions one{.runs = 5, .orders = {1}, .rule = {}, .jobs = 1};
  const TuningOptions three{.runs = 5, .orders = {1}, .rule = {}, .jobs = 3};
  EXPECT_EQ(to_json(tune(scene, one)).dump(), to_json(tune(scene, three)).dump());
}

// Property: gains of a rule lie on its curve; an unknown rule is refused.
TEST(Tune, KeepsToARule) {
  const WorldScene scene = steady_scene("{runs: 3}");
  const Tuning tuning =
      tune(scene, {.runs = 5, .orders = {1}, .rule = "benedict-bordner", .jobs = 1});
  const Gains best = tuning.regimes.at(0).best;
  EXPECT_NEAR(best.h, best.g * best.g / (2.0 - best.g), 1e-12);
  EXPECT_THROW(tune(scene, {.runs = 5, .orders = {1}, .rule = "guess", .jobs = 1}),
               std::invalid_argument);
}

// Property: the fragment is a part of a scene that reads back to the same gains.
TEST(SceneFragment, CanBePasted) {
  const WorldScene scene = steady_scene("{runs: 3}");
  const Tuning tuning = tune(scene, {.runs = 4, .orders = {2}, .rule = {}, .jobs = 1});
  const std::string fragment = scene_fragment(tuning);
  const std::string text =
      "name: pasted\ntargets:\n  - {ball: {type: baseball, position: [0, 0]}}\nsensors:\n  - "
      "{rate: 10}\n" +
      fragment;
  const Scene pasted = read_scene_text(text, "pasted.yaml");
  const FilterConfig& filter = std::get<WorldScene>(pasted).tracker.filters.at("ball");
  const auto& manual = std::get<gain_design::Manual<2>>(std::get<GhkConfig>(filter).design);
  // Gains are printed with four digits.
  EXPECT_NEAR(manual.g, tuning.regimes[0].best.g, 5e-4 * manual.g);
  EXPECT_NEAR(manual.k, tuning.regimes[0].best.k, 5e-4 * manual.k);
  EXPECT_THAT(to_table(tuning), HasSubstr("tuned"));
}

}  // namespace
}  // namespace ghtrack

#include "tools/experiment/tuning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
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
  EXPECT_LT(ball.judged.at(ball.recommended).rmse, 1.05 * *ball.hindsight.best_fixed_gains);
}

// Property: what is recommended is not worse than the scene's own filter on the judging runs, with
// two sensors of different rates and noise, and for a scene whose own filter is the best there is.
TEST(Tune, RecommendsNothingWorseThanTheScenesOwn) {
  const char* const kText = R"(
name: two
duration: 20
targets: [{name: a, train: {stock: ideal, speed: 20, drive: [{at: 5, accelerate: 2}, {at: 10, accelerate: 0}]}}]
sensors:
  - {name: cam, rate: 10, noise: 0.5}
  - {name: far, rate: 3, phase: 0.037, noise: 2}
tracker: {association: known, filters: {default: {gh: {design: tracking-index, process_noise: 1.5}}}}
)";
  const auto scene = std::get<WorldScene>(read_scene_text(kText, "two.yaml"));
  const Tuning tuning = tune(scene, {.runs = 12, .orders = {1, 2}, .rule = {}, .jobs = 2});
  const TunedRegime& train = tuning.regimes.at(0);
  EXPECT_LE(train.judged.at(train.recommended).rmse, judged(train, "scene").rmse);
  EXPECT_FALSE(train.judged.at(train.recommended).text.empty());
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
  const std::string text = judged(tuning.regimes.at(0), "tuned").text;
  double g = 0.0, h = 0.0;
  ASSERT_EQ(std::sscanf(text.c_str(), "{gh: {g: %lf, h: %lf}}", &g, &h), 2) << text;
  EXPECT_NEAR(h, g * g / (2.0 - g), 1e-3 * h);
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
  const Gains gains = *steady_gains(make_filter(filter, tuning.sigma, tuning.period));
  EXPECT_NEAR(gains.g, tuning.regimes[0].best.g, 1e-9);
  EXPECT_NEAR(gains.k, tuning.regimes[0].best.k, 1e-9);
  EXPECT_THAT(to_table(tuning), HasSubstr("tuned"));
}

}  // namespace
}  // namespace ghtrack

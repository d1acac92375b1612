#include "tools/experiment/labelled_objects.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/random.hpp"
#include "tests/tools/experiment/sample_campaign.hpp"
#include "tools/experiment/gain_search.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

using testing::steady_scene;

// Property: the expected error is the mean of measured ones over noise: 300 runs, four standard
// errors of their mean, under a constant acceleration, for a sluggish filter.
TEST(ExpectedErrors, AreTheMeanOfMeasuredOnes) {
  const WorldScene scene = steady_scene("{runs: 300}");
  WorldScene falling = scene;
  falling.environment.gravity = 3.0;
  const Trial trial(falling);
  const GainFilter<2> filter =
      plain_filter(Gains::of_gh(0.3, 0.06), trial.scoring().sigma, trial.scoring().period);
  double sum = 0.0;
  double squares = 0.0;
  double expected = 0.0;
  for (int run = 0; run < 300; ++run) {
    const LabelledObject object = labelled_objects(trial, run, trial.truth_of(run), {0}).at(0);
    const SquaredErrors measured = measured_errors(filter, object);
    const double mean = *measured.position.value();
    sum += mean;
    squares += mean * mean;
    if (run == 0) {
      const SquaredErrors exact = expected_errors(filter, object);
      expected = *exact.position.value();
    }
  }
  const double mean = sum / 300.0;
  const double error = std::sqrt((squares / 300.0 - mean * mean) / 300.0);
  EXPECT_NEAR(mean, expected, 4.0 * error);
  EXPECT_GT(expected, 0.0);
}

/// One object whose acceleration is new and random at every scan (σ_w), seen with σ = 1 at T = 1:
/// the linear-Gaussian model of Kalata's gains.
LabelledObject manoeuvring(double acceleration, std::uint64_t seed, int scans) {
  LabelledObject object;
  TruthState truth;
  for (int i = 0; i < scans; ++i) {
    Stream stream(seed, Purpose::kGeneration, 7, static_cast<std::uint64_t>(i));
    const double ax = acceleration * stream.normal();
    const double ay = acceleration * stream.normal();
    truth.acceleration = Vec2(ax, ay);
    Detection detection;
    const double noise_x = stream.normal();
    const double noise_y = stream.normal();
    detection.position = truth.position + Vec2(noise_x, noise_y);
    object.scans.push_back({static_cast<double>(i), truth, detection});
    truth.position += truth.velocity + 0.5 * truth.acceleration;
    truth.velocity += truth.acceleration;
  }
  return object;
}

// Derived: for this motion no g-h filter beats the steady Kalman filter, whose error is σ √g per
// axis with Kalata's g. Gains tuned on one set of seeds come within 5 % of it on another set.
TEST(Tuning, ComesWithinFivePercentOfTheBound) {
  for (const double index : {0.05, 0.5, 2.0}) {
    const double bound = std::sqrt(2.0 * tracking_index_gains(1, index).g);
    const auto rmse = [&](const Gains& gains, std::uint64_t first_seed) {
      SquaredErrors sum;
      for (std::uint64_t run = 0; run < 10; ++run) {
        sum += measured_errors(plain_filter(gains, 1.0, 1.0),
                               manoeuvring(index, first_seed + run, 600));
      }
      return *sum.position.root();
    };
    const FoundGains found =
        least_cost(stable_gains(1), [&](const Gains& gains) { return rmse(gains, 100); });
    EXPECT_LT(rmse(found.gains, 500), 1.05 * bound) << index;
    EXPECT_GT(rmse(found.gains, 500), 0.95 * bound) << index;
  }
}

// Property: an object is followed from its first detection on, and told apart from clutter.
TEST(LabelledObjects, BeginWithTheFirstDetection) {
  const Trial trial(steady_scene("{runs: 2}"));
  const std::vector<LabelledObject> objects =
      labelled_objects(trial, 1, trial.truth_of(1), some_objects(trial, 1000));
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].scans.size(), 121U);
  EXPECT_TRUE(objects[0].scans.front().detection);
}

}  // namespace
}  // namespace ghtrack

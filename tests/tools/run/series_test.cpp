#include "tools/run/series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ghtrack {
namespace {

SeriesScene weights() {
  SeriesScene scene;
  GivenSeries given;
  given.measurements = {158.0, 164.2, 160.3, 159.9, 162.1, 164.6,
                        169.6, 167.4, 166.4, 171.0, 171.2, 172.6};
  scene.data = given;
  SeriesFilter filter;
  filter.name = "learned";
  filter.x0 = 160.0;
  filter.dx0 = 1.0;
  filter.model = FreeGains<1>{
      .design = gain_design::Manual<1, gain_design::Stability::kFree>{.g = 0.6, .h = 2.0 / 3.0}};
  scene.filters = {filter};
  return scene;
}

// Derived: the textbook's own numbers, three digits (Labbe, Kalman and Bayesian Filters, ch. 1).
TEST(Series, ReproducesTheTextbooksWeights) {
  const SeriesResult result = run(weights());
  const std::vector<double> expected = {159.2, 161.8,   162.1,   160.78,  160.985, 163.311,
                                        168.1, 169.696, 168.204, 169.164, 170.892, 172.629};
  ASSERT_EQ(result.tracks.at(0).rows.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(result.tracks[0].rows[i].x, expected[i], 5e-4);
  }
  EXPECT_FALSE(result.tracks[0].rmse);
}

SeriesScene hallway(double accuracy, std::vector<double> kernel) {
  SeriesScene scene;
  const std::vector<double> map = {1, 1, 0, 0, 0, 0, 0, 0, 1, 0};
  scene.data = WalkSeries{.points = 60, .map = map, .kernel = kernel, .accuracy = 0.9};
  SeriesFilter filter;
  filter.name = "dog";
  filter.model =
      DiscreteBayesConfig{.map = map, .accuracy = accuracy, .movement = 1, .kernel = kernel};
  scene.filters = {filter};
  return scene;
}

double largest(const discrete_bayes::Belief& belief) {
  return *std::max_element(belief.begin(), belief.end());
}

// Property: a dog in a hallway is found by doors; every step spreads the belief, a reading that
// says nothing leaves it as it is, and telling ones gather it again.
TEST(Series, FindsADogInAHallwayByItsDoors) {
  const SeriesTrack heard = run(hallway(0.9, {0.1, 0.8, 0.1})).tracks.at(0);
  int found = 0;
  double lost = 0.0, regained = 0.0;
  for (std::size_t i = 20; i < heard.rows.size(); ++i) {
    found += heard.rows[i].x == *heard.rows[i].truth ? 1 : 0;
    lost += largest(heard.beliefs[i - 1].posterior) - largest(heard.beliefs[i].prior);
    regained += largest(heard.beliefs[i].posterior) - largest(heard.beliefs[i].prior);
  }
  EXPECT_GT(found, 20);  // of 40; by chance it would be 4
  EXPECT_GT(lost, 1.0);
  EXPECT_GT(regained, 1.0);

  const SeriesTrack deaf = run(hallway(0.5, {0.1, 0.8, 0.1})).tracks.at(0);
  for (const SeriesBelief& belief : deaf.beliefs) {
    EXPECT_NEAR(largest(belief.posterior), 0.1, 1e-12);
  }
}

// Derived: without noise the steady lag of a g-h filter behind acceleration a is (1 − g) a T² / h.
TEST(Series, AnAcceleratingTargetIsFollowedWithTheClosedFormLag) {
  SeriesScene scene;
  GeneratedSeries data;
  data.points = 2000;
  data.acceleration = 9.0;
  scene.data = data;
  SeriesFilter filter;
  filter.name = "lagging";
  filter.model = FreeGains<1>{};
  scene.filters = {filter};
  const SeriesRow last = run(scene).tracks.at(0).rows.back();
  EXPECT_NEAR(*last.truth - last.x, 0.8 * 9.0 / 0.02, 1e-6);
}

// Derived: when the guess holds at the first measurement, that measurement is not used.
TEST(Series, TheGuessMayTakeThePlaceOfTheFirstMeasurement) {
  SeriesScene scene = weights();
  scene.initial_guess = GuessAt::kFirstMeasurement;
  const std::vector<SeriesRow> rows = run(scene).tracks.at(0).rows;
  EXPECT_EQ(rows[0].x, 160.0);
  EXPECT_FALSE(rows[0].residual);
  EXPECT_EQ(rows[1].x_pred, 161.0);
}

}  // namespace
}  // namespace ghtrack

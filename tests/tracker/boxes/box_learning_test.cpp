#include "tracker/boxes/box_learning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ghtrack {
namespace {

// Derived: mean 2 and standard deviation √2 of 0, 1, 2, 3, 4.
TEST(ConfidenceScale, CountsStandardDeviationsAboveTheMean) {
  ConfidenceScale scale;
  for (int i = 0; i < 5; ++i) scale.add(i);
  EXPECT_NEAR(scale.standardised(2.0), 0.0, 1e-12);
  EXPECT_NEAR(scale.standardised(4.0), std::sqrt(2.0), 1e-12);
  EXPECT_EQ(scale.standardised(1e9), 4.0);
}

// Property: equal confidences, and what is no number, say nothing.
TEST(ConfidenceScale, SaysNothingWhereThereIsNothingToSay) {
  ConfidenceScale scale;
  for (int i = 0; i < 1000; ++i) scale.add(0.1);
  scale.add(std::numeric_limits<double>::infinity());
  EXPECT_EQ(scale.standardised(0.1), 0.0);
  EXPECT_EQ(scale.standardised(0.3), 0.0);
  EXPECT_EQ(scale.standardised(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

// Derived: the mean square of many speeds outweighs what was assumed.
TEST(SpeedStatistics, GoesFromWhatIsAssumedToWhatIsSeen) {
  SpeedStatistics speed;
  EXPECT_NEAR(speed.variance(0.01), 0.01, 1e-15);
  for (int i = 0; i < 3000; ++i) speed.add({0.3, 0.1});
  EXPECT_NEAR(speed.variance(0.01), (30.0 * 0.01 + 1000.0 * 0.05) / 1030.0, 1e-12);
}

// Property: residuals of objects that manoeuvre three times as much as the filter assumes lift the
// noise until the filter's distances have the median that they should have. Their squared distance
// is that of χ² with 2 degrees of freedom, an exponential of mean 2, over the variance in use.
TEST(VarianceFactor, FindsTheNoiseThatExplainsTheResiduals) {
  for (const double truth : {0.6, 1.0, 3.0, 10.0}) {
    std::mt19937 random(3);
    std::exponential_distribution<double> distance(0.5);
    VarianceFactor manoeuvres(-1.0, 4.0);
    double mean = 0.0;
    for (int i = 0; i < 8000; ++i) {
      manoeuvres.add(distance(random) * truth * truth / manoeuvres.factor());
      if (i >= 4000) mean += 0.5 * std::log(manoeuvres.factor()) / 4000.0;
    }
    EXPECT_NEAR(mean, std::log(truth), 0.1);
  }
}

// Property: the error of a detector's sizes is told from what the objects change by, and one box in
// ten of an object that is hidden in part does not spoil it.
TEST(SizeStatistics, TellsErrorsFromWhatObjectsChangeBy) {
  const SizeStatistics::Variances assumed{0.15 * 0.15, 0.02 * 0.02};
  EXPECT_NEAR(std::sqrt(SizeStatistics().error(assumed)), 0.15, 1e-12);
  for (const double error : {0.03, 0.06, 0.12}) {
    for (const double drift : {0.003, 0.02}) {
      std::mt19937 random(5);
      std::normal_distribution<double> normal;
      std::bernoulli_distribution is_hidden(0.1);
      SizeStatistics sizes;
      double mean = 0.0;
      const auto change = [&](double images) {
        const double usual = std::sqrt(2.0 * error * error + images * drift * drift);
        const double sigma = is_hidden(random) ? 5.0 * usual : usual;
        const double width = sigma * normal(random);
        return Eigen::Vector2d(width, sigma * normal(random));
      };
      for (int i = 0; i < 6000; ++i) {
        sizes.add_after_while(assumed, change(SizeStatistics::kWhile));
        sizes.add_after_two(assumed, change(2.0 * SizeStatistics::kWhile));
        if (i >= 3000) mean += std::sqrt(sizes.error(assumed)) / 3000.0;
      }
      EXPECT_NEAR(mean / error, 1.0, 0.25) << error << " " << drift;
    }
  }
}

// Derived: two of three predictions of two images came true, none of three images.
TEST(CoastingStatistics, TrustsWhatCameTrueMoreOftenThanNot) {
  CoastingStatistics coasting;
  EXPECT_FALSE(coasting.trusts(1));
  coasting.add_found(2, true);
  coasting.add_found(2, true);
  coasting.add_found(3, false);
  EXPECT_TRUE(coasting.trusts(1));
  EXPECT_TRUE(coasting.trusts(2));
  EXPECT_FALSE(coasting.trusts(3));
  coasting.add_lost(3);
  EXPECT_FALSE(coasting.trusts(2));
}

}  // namespace
}  // namespace ghtrack

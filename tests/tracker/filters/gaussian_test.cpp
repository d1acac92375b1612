#include "tracker/filters/gaussian.hpp"

#include <gtest/gtest.h>

namespace ghtrack {
namespace {

// Derived: means and variances of independent variables add.
TEST(Gaussian, AddsMeansAndVariances) {
  EXPECT_EQ(sum({10.0, 0.2 * 0.2}, {15.0, 0.7 * 0.7}), (Gaussian{25.0, 0.2 * 0.2 + 0.7 * 0.7}));
}

// Derived: precisions add, means are weighed by precision.
TEST(Gaussian, MultipliesLikeTwoOpinions) {
  const Gaussian both = product({10.0, 4.0}, {12.0, 1.0});
  EXPECT_NEAR(1.0 / both.variance, 1.0 / 4.0 + 1.0 / 1.0, 1e-15);
  EXPECT_NEAR(both.mean, (10.0 / 4.0 + 12.0 / 1.0) * both.variance, 1e-14);
}

// Derived: an update is the product of prior and likelihood, a prediction their sum.
TEST(Gaussian, UpdateIsAProductAndPredictionASum) {
  const Gaussian prior{11.0, 7.0};
  const Gaussian posterior = updated(prior, 12.0, 12.25).posterior;
  const Gaussian expected = product(prior, {12.0, 12.25});
  EXPECT_NEAR(posterior.mean, expected.mean, 1e-14);
  EXPECT_NEAR(posterior.variance, expected.variance, 1e-14);
  EXPECT_EQ(predicted({10.0, 3.0}, {.control = 1.0, .process_variance = 4.0}),
            sum({10.0, 3.0}, {1.0, 4.0}));
}

}  // namespace
}  // namespace ghtrack

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tools/metrics/batch_means.hpp"
#include "tools/metrics/quantiles.hpp"

namespace ghtrack {
namespace {

// Derived: what stays below the quantile of p has the probability p, by the error function of the C
// library.
TEST(NormalQuantile, InvertsTheErrorFunction) {
  for (const double p : {1e-300, 1e-30, 1e-8, 0.001, 0.025, 0.3, 0.5, 0.7, 0.975, 0.999}) {
    const double reached = 0.5 * std::erfc(-normal_quantile(p) / std::numbers::sqrt2);
    EXPECT_NEAR(reached, p, 1e-12 * p) << p;
  }
  EXPECT_EQ(normal_quantile(0.5), 0.0);
}

// Derived: χ² with two degrees of freedom is exponential with mean 2.
TEST(ChiSquareQuantile, IsALogarithmForTwoDegrees) {
  for (const double probability : {1e-6, 0.025, 0.5, 0.95, 0.975, 0.999999}) {
    const double exact = -2.0 * std::log1p(-probability);
    EXPECT_NEAR(chi_square_quantile(probability, 2.0), exact, 1e-10 * exact) << probability;
  }
}

// Derived: with one degree it is the square of a normal variable, with four
// P = 1 − e^(−x/2) (1 + x/2), and the percentiles of Abramowitz & Stegun table 26.8.
TEST(ChiSquareQuantile, AgreesWithClosedFormsAndTables) {
  EXPECT_NEAR(chi_square_quantile(std::erf(1.0 / std::numbers::sqrt2), 1.0), 1.0, 1e-9);
  const double x = chi_square_quantile(0.3, 4.0);
  EXPECT_NEAR(1.0 - std::exp(-x / 2.0) * (1.0 + x / 2.0), 0.3, 1e-12);
  EXPECT_NEAR(chi_square_quantile(0.975, 10.0), 20.4832, 1e-4);
  EXPECT_NEAR(chi_square_quantile(0.025, 10.0), 3.24697, 1e-5);
  EXPECT_NEAR(chi_square_quantile(0.995, 100.0), 140.169, 1e-3);
}

// Derived: for many degrees the variable is normal, with mean n and variance 2 n; the next term of
// the expansion is 2 (z² − 1) / 3 (Abramowitz & Stegun 26.4.18 expanded).
TEST(ChiSquareQuantile, BecomesNormalForManyDegrees) {
  const double n = 1e5;
  const double z = 1.959963984540054;
  EXPECT_NEAR(chi_square_quantile(0.975, n), n + z * std::sqrt(2.0 * n) + 2.0 / 3.0 * (z * z - 1.0),
              0.02);
}

// Derived: Cauchy for one degree, t / √(2 + t²) = 2 P − 1 for two; Abramowitz & Stegun table 26.10.
TEST(StudentQuantile, AgreesWithClosedFormsAndTables) {
  EXPECT_NEAR(student_quantile(0.9, 1), std::tan(0.4 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(student_quantile(0.975, 2), 0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95)), 1e-9);
  EXPECT_NEAR(student_quantile(0.975, 5), 2.571, 1e-3);
  EXPECT_NEAR(student_quantile(0.975, 10), 2.228, 1e-3);
  EXPECT_NEAR(student_quantile(0.025, 19), -2.093, 1e-3);
}

// Property: where the closed form gives way to its series, quantiles go on falling towards the
// normal one at the same rate, about 1 / degrees.
TEST(StudentQuantile, PassesSmoothlyToTheNormalOne) {
  for (const double probability : {0.9, 0.975, 0.9999}) {
    const auto step = [&](std::int64_t degrees) {
      return student_quantile(probability, degrees) - student_quantile(probability, degrees + 1);
    };
    EXPECT_NEAR(step(1000) / step(999), 1.0, 0.01) << probability;
    EXPECT_NEAR(step(1000) / step(1001), 1.0, 0.01) << probability;
  }
  EXPECT_NEAR(student_quantile(0.975, 1'000'000'000), 1.959963984540054, 1e-8);
}

// Property: the mean is that of all values, whatever the batches.
TEST(BatchMeans, KeepsTheMeanOfEverything) {
  BatchMeans means;
  EXPECT_FALSE(means.confidence95().has_value());
  for (int i = 1; i <= 12345; ++i) means.add(i);
  EXPECT_EQ(means.count(), 12345);
  EXPECT_DOUBLE_EQ(means.mean(), 12346.0 / 2.0);
}

/// What became of the 95 % intervals of many series.
struct Coverage {
  int given = 0;
  int held = 0;  // the true mean

  double share() const { return static_cast<double>(held) / given; }
  double standard_error() const { return std::sqrt(0.95 * 0.05 / given); }
};

/// Squared errors on two axes; on each the error is `memory` times its predecessor plus noise.
Coverage coverage(double memory, int values, int runs) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise;
  const double fresh = std::sqrt(1.0 - memory * memory);
  Coverage all;
  for (int run = 0; run < runs; ++run) {
    BatchMeans means;
    double x = noise(random), y = noise(random);
    for (int i = 0; i < values; ++i) {
      means.add(x * x + y * y);
      x = memory * x + fresh * noise(random);
      y = memory * y + fresh * noise(random);
    }
    const auto interval = means.confidence95();
    if (!interval) continue;
    ++all.given;
    all.held += interval->low <= 2.0 && 2.0 <= interval->high ? 1 : 0;
  }
  return all;
}

// Property: an interval of 95 % holds the true mean square in 93 to 97 % of the series, give or
// take four standard errors of that many series, whatever their length and memory m, down to those
// that are worth n (1 − m²)/(1 + m²) = 30 independent squares.
TEST(BatchMeans, CoversTheMeanOfSquaredErrors) {
  for (const double memory : {0.0, 0.5, 0.8, 0.9, 0.95}) {
    for (const int values : {48, 130, 400, 1000}) {
      const double worth = values * (1.0 - memory * memory) / (1.0 + memory * memory);
      if (worth < 30.0) continue;
      const Coverage seen = coverage(memory, values, 500);
      EXPECT_GE(seen.given, 460) << memory << ", " << values;
      EXPECT_GT(seen.share(), 0.93 - 4.0 * seen.standard_error()) << memory << ", " << values;
      EXPECT_LT(seen.share(), 0.97 + 4.0 * seen.standard_error()) << memory << ", " << values;
    }
  }
}

// Property: a series that is worth one or two independent values is seldom taken for more, and its
// mean has no interval.
TEST(BatchMeans, SaysWhereTheMeanIsNotKnown) {
  EXPECT_LT(coverage(0.99, 100, 400).given, 0.05 * 400);
  BatchMeans few;
  for (int i = 0; i < 15; ++i) few.add(i);
  EXPECT_FALSE(few.confidence95());
}

// Derived: the error of the mean of equal values is none.
TEST(BatchMeans, KnowsTheMeanOfEqualValues) {
  BatchMeans means;
  for (int i = 0; i < 100; ++i) means.add(0.0);
  ASSERT_TRUE(means.confidence95());
  EXPECT_EQ(means.confidence95()->low, 0.0);
  EXPECT_EQ(means.confidence95()->high, 0.0);
}

// Derived: a first-order series with memory m is worth n (1 − m) / (1 + m) independent values; the
// estimate from 32 to 63 batches scatters by a fifth or so, and is averaged over 300 runs.
TEST(BatchMeans, CountsIndependentValues) {
  std::mt19937_64 random(12);
  std::normal_distribution<double> noise;
  double inverse = 0.0;
  for (int run = 0; run < 300; ++run) {
    BatchMeans means;
    double value = 0.0;
    for (int i = 0; i < 3000; ++i) {
      value = 0.5 * value + noise(random);
      means.add(value);
    }
    inverse += 1.0 / means.effective_count() / 300.0;
  }
  EXPECT_NEAR(inverse * 1000.0, 1.0, 0.12);
}

}  // namespace
}  // namespace ghtrack

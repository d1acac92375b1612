#include "tools/experiment/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// Derived: mean 3, s² = 2.5, n = 5, t(0.975, 4) = 2.776445 (tables): half width t √(s²/n).
TEST(MeanOf, GivesStudentsInterval) {
  const std::vector<double> values = {1.0, 2.0, 3.0, 4.0, 5.0};
  const SampleMean mean = mean_of(values, {});
  EXPECT_DOUBLE_EQ(mean.mean, 3.0);
  EXPECT_EQ(mean.values, 5);
  EXPECT_NEAR(mean.ci95->high - 3.0, 2.7764451052 * std::sqrt(0.5), 1e-8);
  EXPECT_NEAR(3.0 - mean.ci95->low, 2.7764451052 * std::sqrt(0.5), 1e-8);
}

// Derived: the root of the mean of 9 and 16 is √12.5.
TEST(MeanOf, AveragesAnRmseAsAMeanSquare) {
  const std::vector<double> values = {3.0, 4.0};
  EXPECT_DOUBLE_EQ(mean_of(values, {.mean_square = true}).mean, std::sqrt(12.5));
}

// Property: runs without a value do not count; one value has no interval, equal ones a point.
TEST(MeanOf, LeavesOutWhatDidNotOccur) {
  const std::vector<double> values = {kNothing, 2.0, kNothing};
  const SampleMean one = mean_of(values, {});
  EXPECT_EQ(one.values, 1);
  EXPECT_EQ(one.mean, 2.0);
  EXPECT_FALSE(one.ci95);
  const std::vector<double> none = {kNothing};
  EXPECT_EQ(mean_of(none, {}).values, 0);
  const std::vector<double> equal = {0.0, 0.0, 0.0};
  EXPECT_EQ(mean_of(equal, {.skewed = true}).ci95->high, 0.0);
}

/// How often the 95 % interval of samples holds their expectation.
double coverage(const Averaging& averaging, double expectation, double (*draw)(Stream&)) {
  constexpr int kSamples = 1000;
  int covered = 0;
  for (int i = 0; i < kSamples; ++i) {
    Stream stream(11, Purpose::kGeneration, 0, static_cast<std::uint64_t>(i));
    std::vector<double> values(60);
    for (double& value : values) value = draw(stream);
    const Interval interval = *mean_of(values, averaging).ci95;
    if (interval.low <= expectation && expectation <= interval.high) ++covered;
  }
  return covered / double{kSamples};
}

// Property: a 95 % interval misses one time in twenty; 1000 samples tell that to ±0.028 (four
// standard errors). The bootstrap of a skewed mean and the delta method are a little optimistic.
TEST(MeanOf, CoversTheExpectationAsOftenAsItSays) {
  EXPECT_NEAR(coverage({}, 0.0, [](Stream& s) { return s.normal(); }), 0.95, 0.028);
  EXPECT_NEAR(coverage({.skewed = true}, 1.0, [](Stream& s) { return s.exponential(); }), 0.94,
              0.03);
  EXPECT_NEAR(coverage({.mean_square = true}, 1.0, [](Stream& s) { return s.normal(); }), 0.94,
              0.03);
}

// Derived: pairs that differ by 0.5 ± small have a narrow interval, however much both vary.
TEST(PairedDifference, CancelsWhatBothShare) {
  std::vector<double> a, b;
  Stream stream(3, Purpose::kGeneration, 1, 0);
  for (int i = 0; i < 100; ++i) {
    const double shared = 10.0 * stream.normal();
    const double own = 0.1 * stream.normal();
    a.push_back(shared + own + 0.5);
    b.push_back(shared);
  }
  const PairedDifference difference = paired_difference(a, b, {}, 0.95);
  EXPECT_NEAR(difference.value, 0.5, 0.05);
  EXPECT_LT(difference.interval->high - difference.interval->low, 0.06);
  EXPECT_GT(difference.interval->low, 0.4);
}

// Derived: for roots the interval is that of the linearised difference; both roots are told
// exactly.
TEST(PairedDifference, OfRootsIsTheDifferenceOfTheRoots) {
  const std::vector<double> a = {3.0, 5.0, 4.0, 6.0};
  const std::vector<double> b = {1.0, 2.0, 1.5, 2.5};
  const PairedDifference difference = paired_difference(a, b, {.mean_square = true}, 0.95);
  const double root_a = std::sqrt((9.0 + 25.0 + 16.0 + 36.0) / 4.0);
  const double root_b = std::sqrt((1.0 + 4.0 + 2.25 + 6.25) / 4.0);
  EXPECT_DOUBLE_EQ(difference.value, root_a - root_b);
  EXPECT_GT(difference.interval->low, 0.0);
}

// Property: a higher confidence widens the interval of either kind; the same input gives the same.
TEST(PairedDifference, WidensWithItsConfidence) {
  const std::vector<double> a = {1.0, 4.0, 2.0, 8.0, 5.0, 7.0};
  const std::vector<double> b = {1.0, 3.0, 2.5, 6.0, 5.5, 6.0};
  for (const Averaging& averaging : {Averaging{}, Averaging{.skewed = true}}) {
    const Interval narrow = *paired_difference(a, b, averaging, 0.90).interval;
    const Interval wide = *paired_difference(a, b, averaging, 0.99).interval;
    EXPECT_LT(wide.low, narrow.low);
    EXPECT_GT(wide.high, narrow.high);
    EXPECT_EQ(paired_difference(a, b, averaging, 0.90).interval->low, narrow.low);
  }
}

// Derived: linear interpolation between order statistics.
TEST(SampleQuantile, Interpolates) {
  const std::vector<double> values = {4.0, kNothing, 1.0, 3.0, 2.0};
  EXPECT_DOUBLE_EQ(sample_quantile(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(sample_quantile(values, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(sample_quantile(values, 1.0), 4.0);
  EXPECT_TRUE(std::isnan(sample_quantile({}, 0.5)));
}

}  // namespace
}  // namespace ghtrack

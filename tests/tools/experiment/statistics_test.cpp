#include "tools/experiment/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "sim/random.hpp"
#include "tools/metrics/mean.hpp"

namespace ghtrack {
namespace {

// Derived: mean 3, s² = 2.5, n = 5, t(0.975, 4) = 2.776445 and t(0.9825, 4) = 3.135495: half
// width t √(s²/n), on the logarithm of what is positive.
TEST(MeanOf, GivesStudentsInterval) {
  const std::vector<double> values = {1.0, 2.0, 3.0, 4.0, 5.0};
  const SampleMean mean = mean_of(values, Average::kMean);
  EXPECT_DOUBLE_EQ(mean.mean, 3.0);
  EXPECT_EQ(mean.values, 5);
  EXPECT_NEAR(mean.ci95->high - 3.0, 2.776445 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(3.0 - mean.ci95->low, 2.776445 * std::sqrt(0.5), 1e-5);
  const SampleMean positive = mean_of(values, Average::kPositiveMean);
  EXPECT_NEAR(std::log(positive.ci95->high / 3.0), 3.135495 * std::sqrt(0.5) / 3.0, 1e-5);
  EXPECT_NEAR(positive.ci95->low * positive.ci95->high, 9.0, 1e-9);
}

// Derived: the root of the mean of 9 and 16 is √12.5.
TEST(MeanOf, AveragesAnRmseAsAMeanSquare) {
  const std::vector<double> values = {3.0, 4.0};
  EXPECT_DOUBLE_EQ(mean_of(values, Average::kRootMeanSquare).mean, std::sqrt(12.5));
}

// Property: runs without a value do not count; a few have no interval.
TEST(MeanOf, LeavesOutWhatDidNotOccur) {
  const std::vector<double> values = {kNothing, 2.0, kNothing};
  const SampleMean one = mean_of(values, Average::kMean);
  EXPECT_EQ(one.values, 1);
  EXPECT_EQ(one.mean, 2.0);
  const std::vector<double> none = {kNothing};
  EXPECT_EQ(mean_of(none, Average::kMean).values, 0);
  for (const Average average : {Average::kMean, Average::kMedian, Average::kCount}) {
    const std::vector<double> four = {1.0, 2.0, kNothing, 3.0, 4.0};
    EXPECT_FALSE(mean_of(four, average).ci95);
  }
}

// Derived: the mid-P interval of a Poisson mean with no event in five runs ends where half of
// e^(−5μ) is 0.025, at 0.599; Wilson's of five trials that all succeed begins at n / (n + z²) =
// 0.566.
TEST(MeanOf, KnowsThatNothingSeenIsNotNothing) {
  const std::vector<double> never(5, 0.0);
  const Interval losses = *mean_of(never, Average::kCount).ci95;
  EXPECT_EQ(losses.low, 0.0);
  EXPECT_NEAR(losses.high, std::log(20.0) / 5.0, 1e-9);
  const std::vector<double> always(5, 1.0);
  const Interval share = *mean_of(always, Average::kShare).ci95;
  EXPECT_NEAR(share.low, 0.566, 1e-3);
  EXPECT_EQ(share.high, 1.0);
}

// Derived: of ten values the third to the eighth hold the median with 89.1 % and the second to the
// ninth with 97.9 %; 95 % lie in between. Of five, the extremes hold it with 93.75 %.
TEST(MeanOf, PutsTheMedianBetweenOrderStatistics) {
  const std::vector<double> ten = {9.0, 1.0, 5.0, 3.0, 7.0, 2.0, 8.0, 4.0, 6.0, 10.0};
  const SampleMean median = mean_of(ten, Average::kMedian);
  EXPECT_DOUBLE_EQ(median.mean, 5.5);
  EXPECT_GT(median.ci95->low, 2.0);
  EXPECT_LT(median.ci95->low, 3.0);
  EXPECT_NEAR(median.ci95->low + median.ci95->high, 11.0, 1e-9);
  const std::vector<double> five = {2.0, 9.0, 4.0, 1.0, 3.0};
  EXPECT_EQ(mean_of(five, Average::kMedian).ci95->high, 9.0);
}

// Derived: of many values so many lie below the median as coins show heads, n / 2 ± 1.96 √n / 2; a
// few more or less make no jump where the normal distribution takes over from the binomial.
TEST(MeanOf, TakesOrderStatisticsOfManyValues) {
  const auto ramp = [](int count) {
    std::vector<double> values(static_cast<std::size_t>(count));
    std::iota(values.begin(), values.end(), 0.0);
    return values;
  };
  const Interval many = *mean_of(ramp(10001), Average::kMedian).ci95;
  EXPECT_NEAR(many.low, 5000.0 - 0.5 * 1.959964 * std::sqrt(10001.0), 1e-3);
  EXPECT_NEAR(many.high, 5000.0 + 0.5 * 1.959964 * std::sqrt(10001.0), 1e-3);
  const Interval below = *mean_of(ramp(500), Average::kMedian).ci95;
  const Interval above = *mean_of(ramp(501), Average::kMedian).ci95;
  EXPECT_NEAR(above.high - above.low, below.high - below.low, 0.5);
}

// Property: one run that makes nearly all of the mean is said.
TEST(MeanOf, TellsHeavyTails) {
  const std::vector<double> values = {1.0, 1.1, 0.9, 1.05, 80.0, 0.95};
  const SampleMean mean = mean_of(values, Average::kRootMeanSquare);
  EXPECT_TRUE(mean.has_heavy_tails);
  EXPECT_NEAR(mean.median, 1.025, 1e-12);
  EXPECT_LE(mean.median_ci95->high, 80.0);
  EXPECT_GT(mean.median_ci95->high, 1.1);
}

/// How often the 95 % interval of a sample of so many runs holds the expectation.
double coverage(Average average, std::size_t runs, double expectation, double (*draw)(Stream&)) {
  constexpr int kSamples = 2000;
  int covered = 0, told = 0;
  for (int i = 0; i < kSamples; ++i) {
    Stream stream(11, Purpose::kGeneration, runs, static_cast<std::uint64_t>(i));
    std::vector<double> values(runs);
    for (double& value : values) value = draw(stream);
    const auto interval = mean_of(values, average).ci95;
    if (!interval) continue;
    ++told;
    if (interval->low <= expectation && expectation <= interval->high) ++covered;
  }
  EXPECT_GT(told, kSamples / 2);
  return static_cast<double>(covered) / static_cast<double>(told);
}

/// Mean 1, coefficient of variation 0.5, skewness 1.6.
double lognormal(Stream& stream) {
  const double variance = std::log(1.25);
  return std::exp(std::sqrt(variance) * stream.normal() - 0.5 * variance);
}

// Property: a 95 % interval misses one time in twenty. 2000 samples tell that to ±0.015 (three
// standard errors); what is skewed may lack two in a hundred, counts are told more than they ask,
// and of rare failures no interval can be told that never holds more often than it says.
TEST(MeanOf, CoversTheExpectationAsOftenAsItSays) {
  for (const std::size_t runs : {5U, 10U, 20U, 50U}) {
    const auto covers = [&](Average average, double expectation, double (*draw)(Stream&),
                            double most = 0.99) {
      const double share = coverage(average, runs, expectation, draw);
      EXPECT_GT(share, 0.915) << runs << " runs, " << interval_kind(average);
      EXPECT_LE(share, most) << runs << " runs, " << interval_kind(average);
    };
    covers(Average::kMean, 0.0, [](Stream& s) { return s.normal(); });
    covers(Average::kPositiveMean, 1.0, lognormal);
    covers(Average::kPositiveMean, 1.0, [](Stream& s) { return s.exponential(); });
    covers(Average::kRootMeanSquare, 1.0, [](Stream& s) { return std::sqrt(lognormal(s)); });
    covers(Average::kMedian, std::log(2.0), [](Stream& s) { return s.exponential(); });
    covers(Average::kCount, 0.7, [](Stream& s) { return double{1.0} * s.poisson(0.7); });
    covers(Average::kCount, 0.05, [](Stream& s) { return double{1.0} * s.poisson(0.05); });
    covers(Average::kCount, 3.0, [](Stream& s) { return double{1.0} * s.poisson(3.0); });
    covers(Average::kRate, 0.375,
           [](Stream& s) { return std::max(0.0, (4.0 * s.uniform() - 1.0) / 3.0); });
    covers(
        Average::kShare, 0.97, [](Stream& s) { return s.uniform() < 0.97 ? 1.0 : 0.0; }, 1.0);
    covers(Average::kShare, 2.0 / 3.0, [](Stream& s) { return std::sqrt(s.uniform()); });
  }
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
  const PairedDifference difference = paired_difference(a, b, Average::kMean, 0.95);
  EXPECT_NEAR(difference.value, 0.5, 0.05);
  EXPECT_LT(difference.interval->high - difference.interval->low, 0.06);
  EXPECT_GT(difference.interval->low, 0.4);
}

// Derived: √ā − √b̄, exactly.
TEST(PairedDifference, OfRootsIsTheDifferenceOfTheRoots) {
  const std::vector<double> a = {3.0, 5.0, 4.0, 6.0, 5.0};
  const std::vector<double> b = {1.0, 2.0, 1.5, 2.5, 2.0};
  const PairedDifference difference = paired_difference(a, b, Average::kRootMeanSquare, 0.95);
  const double root_a = std::sqrt((9.0 + 25.0 + 16.0 + 36.0 + 25.0) / 5.0);
  const double root_b = std::sqrt((1.0 + 4.0 + 2.25 + 6.25 + 4.0) / 5.0);
  EXPECT_NEAR(difference.value, root_a - root_b, 1e-12);
  EXPECT_GT(difference.interval->low, 0.0);
}

// Property: a higher confidence widens the interval; the same input gives the same.
TEST(PairedDifference, WidensWithItsConfidence) {
  const std::vector<double> a = {1.0, 4.0, 2.0, 8.0, 5.0, 7.0, 3.0, 9.0, 2.2, 3.1};
  const std::vector<double> b = {1.1, 3.0, 2.5, 6.0, 5.7, 6.1, 2.0, 9.6, 2.0, 2.7};
  for (const Average average : {Average::kMean, Average::kPositiveMean, Average::kMedian}) {
    const Interval narrow = *paired_difference(a, b, average, 0.80).interval;
    const Interval wide = *paired_difference(a, b, average, 0.99).interval;
    EXPECT_LT(wide.low, narrow.low);
    EXPECT_GT(wide.high, narrow.high);
    EXPECT_EQ(paired_difference(a, b, average, 0.80).interval->low, narrow.low);
  }
}

/// How often two filters that are alike are told apart.
double false_alarms(Average average, std::size_t runs, double (*draw)(Stream&)) {
  constexpr int kSamples = 2000;
  int apart = 0;
  for (int i = 0; i < kSamples; ++i) {
    Stream stream(12, Purpose::kGeneration, runs, static_cast<std::uint64_t>(i));
    std::vector<double> a(runs), b(runs);
    for (double& value : a) value = draw(stream);
    for (double& value : b) value = draw(stream);
    const auto interval = paired_difference(a, b, average, 0.95).interval;
    if (interval && (interval->low > 0.0 || interval->high < 0.0)) ++apart;
  }
  return apart / double{kSamples};
}

// Property: equal filters differ in one campaign of twenty at most, to 0.015 (three standard errors
// of 2000), whatever the tails and however few the runs.
TEST(PairedDifference, IsRarelyFoundWhereThereIsNone) {
  for (const std::size_t runs : {5U, 10U, 20U, 50U}) {
    const auto is_rare = [&](Average average, double (*draw)(Stream&)) {
      EXPECT_LT(false_alarms(average, runs, draw), 0.065) << runs << interval_kind(average);
    };
    is_rare(Average::kMean, [](Stream& s) { return s.normal(); });
    is_rare(Average::kRootMeanSquare, [](Stream& s) { return std::exp(s.normal()); });
    is_rare(Average::kPositiveMean, [](Stream& s) { return s.exponential(); });
    is_rare(Average::kMedian, [](Stream& s) { return s.exponential(); });
    is_rare(Average::kCount, [](Stream& s) { return double{1.0} * s.poisson(0.1); });
    is_rare(Average::kCount, [](Stream& s) { return double{1.0} * s.poisson(1.0); });
    is_rare(Average::kShare, [](Stream& s) { return s.uniform() < 0.1 ? 0.5 : 1.0; });
  }
}

// Derived: the width of an interval falls as 1/√n, so four times the runs halve it; a difference of
// 0.25 in [-0.25, 0.75] leaves zero then.
TEST(RunsToDecide, FollowFromTheWidth) {
  const PairedDifference difference{.value = 0.25, .interval = Interval{-0.25, 0.75}, .pairs = 10};
  EXPECT_EQ(runs_to_decide(difference, 0.01), 40.0);
  const PairedDifference none{.value = 0.0, .interval = Interval{-0.25, 0.25}, .pairs = 10};
  EXPECT_EQ(runs_to_decide(none, 0.05), 250.0);
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

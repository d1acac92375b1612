#include "tools/experiment/verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/random.hpp"
#include "tests/effort.hpp"

namespace ghtrack {
namespace {

/// Filters that are alike: values of the same distribution, part of which they share.
std::vector<FilterRuns> alike(std::size_t filters, std::size_t runs, std::uint64_t campaign,
                              double (*draw)(Stream&)) {
  std::vector<FilterRuns> all(filters);
  for (std::size_t run = 0; run < runs; ++run) {
    Stream stream(14, Purpose::kGeneration, campaign, run);
    for (FilterRuns& filter : all) {
      filter.values.push_back(draw(stream));
      filter.followed.push_back(1.0);
    }
  }
  return all;
}

bool names_a_best(const std::vector<FilterVerdict>& verdicts) {
  return std::any_of(verdicts.begin(), verdicts.end(), [](const FilterVerdict& verdict) {
    return verdict.significance == Significance::kBest;
  });
}

// Property: of filters that are alike one is called the best in one campaign of twenty at most, to
// three standard errors, by every metric that has a better and a worse, however few the runs and
// however many the filters.
TEST(Verdict, NamesNoBestOfEqualFilters) {
  constexpr int kCampaigns = testing::samples(2000);
  for (const Metric metric : all_metrics()) {
    if (info(metric).better == Better::kNeither) continue;
    double (*draw)(Stream&) = [](Stream& s) { return std::exp(0.7 * s.normal()); };
    if (info(metric).average == Average::kCount) {
      draw = [](Stream& s) { return double{1.0} * s.poisson(0.4); };
    } else if (info(metric).average == Average::kShare) {
      draw = [](Stream& s) { return s.uniform() < 0.3 ? s.uniform() : 1.0; };
    }
    for (const std::size_t filters : {2U, 4U}) {
      for (const std::size_t runs : {5U, 10U, 20U, 50U}) {
        int named = 0;
        for (int i = 0; i < kCampaigns; ++i) {
          for (const bool may_be_ruined : {false, true}) {
            if (may_be_ruined && metric != Metric::kRmsePosition) continue;
            named += names_a_best(judged(metric, alike(filters, runs, i, draw), may_be_ruined));
          }
        }
        const double share = named / (metric == Metric::kRmsePosition ? 2.0 : 1.0) / kCampaigns;
        EXPECT_LT(share, 0.05 + 3.0 * std::sqrt(0.05 * 0.95 / kCampaigns))
            << info(metric).name << ", " << filters << " filters, " << runs;
      }
    }
  }
}

// Property: a filter that keeps the easy part of what it follows does not win by it.
TEST(Verdict, NamesNoFilterThatLosesItsObjects) {
  std::vector<FilterRuns> filters(2);
  for (int run = 0; run < 30; ++run) {
    const double noise = 0.01 * (run % 7);
    filters[0].values.push_back(1.0 + noise);
    filters[0].followed.push_back(1.0);
    filters[1].values.push_back(0.5 + noise);
    filters[1].followed.push_back(0.6 + noise);
  }
  const auto verdicts = judged(Metric::kRmsePosition, filters, false);
  EXPECT_EQ(verdicts[0].significance, Significance::kBest);
  EXPECT_EQ(verdicts[1].significance, Significance::kWorse);
}

// Property: where a run may ruin a mean the median is judged, and the mean has no interval.
TEST(Verdict, JudgesMediansWhereARunMayRuinAMean) {
  std::vector<FilterRuns> filters(2);
  for (int run = 0; run < 20; ++run) {
    filters[0].values.push_back(run == 3 ? 500.0 : 1.0 + 0.01 * (run % 5));
    filters[1].values.push_back(1.5 + 0.01 * (run % 5));
    for (FilterRuns& filter : filters) filter.followed.push_back(1.0);
  }
  const auto verdicts = judged(Metric::kRmsePosition, filters, true);
  EXPECT_EQ(verdicts[0].significance, Significance::kBest);
  EXPECT_FALSE(verdicts[0].mean.ci95);
  EXPECT_TRUE(verdicts[0].mean.has_heavy_tails);
  EXPECT_TRUE(verdicts[0].mean.median_ci95);
}

}  // namespace
}  // namespace ghtrack

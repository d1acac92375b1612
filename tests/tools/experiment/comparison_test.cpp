#include "tools/experiment/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/tools/experiment/sample_campaign.hpp"
#include "tools/experiment/run_table.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

using testing::all_results;
using testing::campaign_of_scene;
using ::testing::HasSubstr;
using testing::steady_scene;

const char* const kThree =
    "{runs: 60, filters: {tiny: {gh: {g: 0.05, h: 0.001}}, large: {gh: {g: 0.8, h: 0.5}}, "
    "twin: {gh: {g: 0.8, h: 0.5}}}}";

const ComparisonRow& row_of(const Comparison& comparison, const std::string& filter,
                            const std::string& regime, Metric metric) {
  for (const ComparisonRow& row : comparison.rows) {
    if (comparison.filters[row.filter] == filter && row.regime == regime && row.object.empty() &&
        row.metric == metric) {
      return row;
    }
  }
  throw std::runtime_error("no such row");
}

Comparison compared(const Campaign& campaign, int jobs = 1) {
  return ghtrack::compare(campaign, groups_by_truth(campaign), all_results(campaign, jobs), jobs);
}
Comparison compared(const std::string& compare, int jobs = 1) {
  return compared(campaign_of_scene(steady_scene(compare)), jobs);
}

// Derived: at constant velocity small gains leave less noise: √(2 VRF) σ, within the interval of
// what was measured (four half widths); the start-up makes the small gains a little worse.
TEST(Comparison, NamesTheWinnerThatTheoryNames) {
  const Comparison comparison = compared(kThree);
  const ComparisonRow& tiny = row_of(comparison, "tiny", "ball", Metric::kRmsePosition);
  const ComparisonRow& large = row_of(comparison, "large", "ball", Metric::kRmsePosition);
  EXPECT_EQ(tiny.significance, Significance::kBest);
  EXPECT_EQ(large.significance, Significance::kWorse);
  EXPECT_GT(large.difference_ci95->low, 0.0);
  EXPECT_EQ(tiny.difference, 0.0);
  EXPECT_EQ(large.gains, "gh g=0.8 h=0.5");
  EXPECT_EQ(large.runs, 60);
  const double noise = 0.5 * std::sqrt(2.0 * variance_reduction(Gains::of_gh(0.8, 0.5), 0.1).x);
  EXPECT_NEAR(large.mean, noise, 2.0 * (large.ci95->high - large.ci95->low));
  EXPECT_NEAR(*large.predicted, noise, 0.01);
  EXPECT_LT(*tiny.hindsight.best_fixed_gains, tiny.ci95->high);
  EXPECT_LT(*large.hindsight.best_fixed_gains, large.ci95->low);
}

// Derived: the velocity's and the innovation's steady errors, for the large gains.
TEST(Comparison, PredictsVelocityAndInnovation) {
  const Comparison comparison = compared(kThree);
  for (const Metric metric : {Metric::kRmseVelocity, Metric::kMai}) {
    const ComparisonRow& row = row_of(comparison, "large", "ball", metric);
    EXPECT_NEAR(*row.predicted, row.mean, 0.02 * row.mean) << info(metric).name;
  }
  const ComparisonRow& nis = row_of(comparison, "large", "ball", Metric::kNis);
  EXPECT_NEAR(nis.mean, 2.0, 4.0 * (nis.ci95->high - nis.ci95->low));
}

// Property: equal filters are tied, whichever of them is called the best one.
TEST(Comparison, CallsEqualFiltersTied) {
  const Comparison comparison = compared(
      "{runs: 20, filters: {large: {gh: {g: 0.8, h: 0.5}}, twin: {gh: {g: 0.8, h: 0.5}}}}");
  EXPECT_EQ(row_of(comparison, "large", "ball", Metric::kRmsePosition).significance,
            Significance::kTied);
  EXPECT_EQ(row_of(comparison, "twin", "ball", Metric::kRmsePosition).significance,
            Significance::kTied);
}

// Property: a difference that a few runs cannot tell is not called a tie, and what would tell it is
// said.
TEST(Comparison, CallsUndecidedWhatItIs) {
  const Comparison comparison =
      compared("{runs: 6, filters: {a: {gh: {g: 0.50, h: 0.20}}, b: {gh: {g: 0.52, h: 0.19}}}}");
  const ComparisonRow& a = row_of(comparison, "a", "ball", Metric::kPeakError);
  const ComparisonRow& b = row_of(comparison, "b", "ball", Metric::kPeakError);
  EXPECT_EQ(a.significance, Significance::kUndecided);
  EXPECT_EQ(b.significance, Significance::kUndecided);
  EXPECT_GT(a.runs_to_decide.value_or(b.runs_to_decide.value_or(0.0)), 6.0);
}

// Property: no winner without runs to judge by, or without a rival.
TEST(Comparison, NamesNoWinnerWithoutEvidence) {
  const Comparison one_run =
      compared("{runs: 1, filters: {a: {gh: {g: 0.8, h: 0.5}}, b: {gh: {g: 0.1, h: 0.01}}}}");
  const ComparisonRow& row = row_of(one_run, "a", "ball", Metric::kRmsePosition);
  EXPECT_EQ(row.significance, Significance::kTooFew);
  EXPECT_FALSE(row.ci95);
  const Comparison alone = compared("{runs: 5}");
  EXPECT_EQ(row_of(alone, "scene", "ball", Metric::kRmsePosition).significance,
            Significance::kNone);
}

// Property: the same bytes for any number of threads.
TEST(Comparison, IsTheSameForAnyNumberOfThreads) {
  const Comparison one = compared(kThree, 1);
  for (const int jobs : {2, 3, 8}) {
    const Comparison several = compared(kThree, jobs);
    EXPECT_EQ(comparison_csv(several), comparison_csv(one));
    EXPECT_EQ(to_json(several).dump(), to_json(one).dump());
  }
}

// Property: a name made for a spreadsheet's formula stays text, a name with a comma one cell.
TEST(Comparison, WritesHostileNamesAsText) {
  WorldScene scene = steady_scene("{runs: 2}");
  scene.targets[0].name = "=1+1, \"x\"";
  const Campaign campaign = campaign_of_scene(scene);
  const std::string csv = comparison_csv(compared(campaign));
  EXPECT_THAT(csv, HasSubstr("steady,ball,\"'=1+1, \"\"x\"\"\",scene"));
  EXPECT_EQ(csv.find("\nscene"), std::string::npos);
}

// Property: the curve of a filter covers the scene's time, and its band holds its mean.
TEST(Comparison, DrawsErrorsOverTime) {
  const Comparison comparison = compared(kThree);
  ASSERT_EQ(comparison.cells.size(), 1U);
  const std::vector<ErrorCurve>& curves = comparison.cells[0].curves;
  ASSERT_EQ(curves.size(), 3U);
  for (const ErrorCurve& curve : curves) {
    ASSERT_GT(curve.points.size(), 40U);
    for (const ErrorCurve::Point& point : curve.points) {
      EXPECT_LE(point.band.low, point.rmse);
      EXPECT_GE(point.band.high, point.rmse);
    }
  }
}

// Property: the surface is least where the bound says that a filter can be, and unstable gains have
// no value.
TEST(Comparison, MapsTheErrorOverGains) {
  const Comparison comparison = compared(kThree);
  const GainSurface& surface = comparison.cells[0].surfaces.at(0);
  ASSERT_EQ(surface.rmse.size(), surface.g.size() * surface.h.size());
  const double least = *std::min_element(surface.rmse.begin(), surface.rmse.end());
  const double bound =
      *row_of(comparison, "tiny", "ball", Metric::kRmsePosition).hindsight.best_fixed_gains;
  EXPECT_NEAR(least, bound, 0.1 * bound);
  EXPECT_LT(surface.best.g, 0.1);
  EXPECT_EQ(surface.marks.size(), 3U);
}

// Property: one row per run, filter and subject, under as many columns as the header has.
TEST(RunTable, HasARowForEverySubject) {
  const Campaign campaign = campaign_of_scene(steady_scene(kThree));
  const Trial trial(campaign.cells[0].scene);
  const std::string rows = run_table_rows(campaign.cells[0], trial, 2, trial.scores(2));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 9);  // puck, ball, scene × 3
  const std::string header = run_table_header();
  const std::string first = rows.substr(0, rows.find('\n') + 1);
  EXPECT_EQ(std::count(first.begin(), first.end(), ','),
            std::count(header.begin(), header.end(), ','));
  EXPECT_THAT(first, ::testing::StartsWith("steady,,2," + std::to_string(seed_of_run(5, 2)) +
                                           ",large,ball,puck,"));
}

}  // namespace
}  // namespace ghtrack

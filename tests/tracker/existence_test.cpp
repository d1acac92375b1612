#include "tracker/existence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/tracker/scans.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kSigma = 1.0;
constexpr double kSide = 300.0;

TrackerDesign design(Association association, double detection_probability, double clutter) {
  return testing::told_design(association, kSide, detection_probability, clutter);
}

Scan seen_at(double time, const std::vector<Vector2d>& positions) {
  return testing::scan_of(time, positions, kSigma);
}

// Derived: Bayes' rule for "there is a target" and "it was missed".
TEST(Existence, FallsWithAMissAsBayesRuleSays) {
  EXPECT_DOUBLE_EQ(after_miss(0.5, 0.9), 0.05 / 0.55);
  EXPECT_DOUBLE_EQ(after_miss(0.0, 0.9), 0.0);
  EXPECT_DOUBLE_EQ(after_miss(1.0, 0.9), 1.0);  // who is certain cannot be told otherwise
  EXPECT_DOUBLE_EQ(after_miss(0.7, 0.0), 0.7);
}

// Derived: e^(−t / lifetime), whatever the steps that the time is cut into.
TEST(Existence, SurvivalIsPerTimeNotPerScan) {
  EXPECT_DOUBLE_EQ(survival(10.0, 10.0), std::exp(-1.0));
  EXPECT_NEAR(std::pow(survival(0.25, 7.0), 40), survival(10.0, 7.0), 1e-14);
}

// Property: a track is confirmed by detections, not by time; its id is given then; a target that is
// gone is given up after a few misses, and faster the better the sensor is.
TEST(Existence, ConfirmsAndLetsGoByEvidence) {
  for (const Association association :
       {Association::kNearestGlobal, Association::kProbabilistic, Association::kMultiScan}) {
    int scans_to_let_go[2] = {};
    for (const double p : {0.5, 0.95}) {
      const TrackerDesign tracker = design(association, p, 10.0);
      TrackerState state = step(tracker, {}, seen_at(0, {Vector2d(100, 100)}));
      ASSERT_EQ(state.tracks.size(), 1U);
      EXPECT_LT(state.tracks[0].id, 0);
      EXPECT_EQ(state.tracks[0].status, TrackStatus::kTentative);
      for (int i = 1; i <= 6; ++i) {
        state = step(tracker, std::move(state), seen_at(i, {Vector2d(100 + i, 100)}));
      }
      ASSERT_FALSE(state.tracks.empty());
      EXPECT_EQ(state.tracks[0].id, 1);
      EXPECT_EQ(state.tracks[0].status, TrackStatus::kConfirmed);
      EXPECT_GT(*state.tracks[0].existence, 0.98);
      for (std::size_t k = 1; k < state.tracks.size(); ++k) {  // what may have taken a detection
        EXPECT_EQ(state.tracks[k].status, TrackStatus::kTentative);
      }
      int misses = 0;
      while (!state.tracks.empty() && state.tracks[0].status != TrackStatus::kTentative) {
        state = step(tracker, std::move(state), seen_at(7 + misses++, {}));
      }
      scans_to_let_go[p > 0.9] = misses;
    }
    EXPECT_GT(scans_to_let_go[0], scans_to_let_go[1]);
    EXPECT_LE(scans_to_let_go[1], 3);
  }
}

// Property: where the sensor cannot see, a miss says nothing: existence falls by survival alone.
TEST(Existence, CountsMissesOnlyWhereTheSensorSees) {
  const TrackerDesign tracker = design(Association::kNearestGlobal, 0.95, 10.0);
  TrackerState state;
  for (int i = 0; i < 10; ++i) {
    state = step(tracker, std::move(state), seen_at(i, {Vector2d(kSide - 19 + 2 * i, 100)}));
  }
  ASSERT_EQ(state.tracks.size(), 1U);
  double before = *state.tracks[0].existence;
  for (int i = 10; i < 15; ++i) {  // at x = 301 and on
    state = step(tracker, std::move(state), seen_at(i, {}));
    ASSERT_EQ(state.tracks.size(), 1U);
    EXPECT_NEAR(*state.tracks[0].existence, before * survival(1.0, 200.0), 1e-12);
    before = *state.tracks[0].existence;
  }
}

// Property: partial scans show one of three targets at a time; a miss counts when the next look at
// a target is over, so all three keep one track each through two turns without one.
TEST(Existence, PartialScansCountMissesInTime) {
  for (const LifeCycle life_cycle : {LifeCycle::kExistence, LifeCycle::kCounts}) {
    TrackerConfig config;
    config.life_cycle = life_cycle;
    KalmanCvConfig filter;
    filter.initial_speed = 30.0;
    config.filters["default"] = filter;
    const TrackerDesign tracker(
        config,
        {{.period = 4.0, .sigma = 10.0, .field_of_view = {}, .coverage = Coverage::kPartial}});
    TrackerState state;
    for (int turn = 0; turn < 30; ++turn) {
      for (int target = 0; target < 3; ++target) {
        if (target == 1 && (turn == 12 || turn == 20)) continue;
        const double t = 4.0 * turn + 1.1 * target;
        Scan scan{.time = t, .sensor = 0, .detections = {}};
        scan.detections.push_back({.position = {5000.0 * target + 10.0 * t, 1000.0 - 5.0 * t},
                                   .covariance = 100.0 * Eigen::Matrix2d::Identity(),
                                   .label = {}});
        state = step(tracker, std::move(state), scan);
      }
      if (turn < 4) continue;
      const TrackSnapshot now = snapshot(state);
      ASSERT_EQ(now.tracks.size(), 3U) << turn;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(now.tracks[i].id, static_cast<int>(i) + 1);
        EXPECT_NE(now.tracks[i].status, TrackStatus::kTentative);
      }
    }
  }
}

/// ln p of 200 scans of a target that stands in clutter, for a tracker told these numbers.
double log_likelihood(Association association, double detection_probability, double clutter) {
  const TrackerDesign tracker = design(association, detection_probability, clutter);
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, kSigma);
  std::uniform_real_distribution<double> unit;
  std::poisson_distribution<int> count(5.0);
  TrackerState state;
  double sum = 0.0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Vector2d> seen;
    if (unit(random) < 0.8) seen.emplace_back(150 + noise(random), 150 + noise(random));
    for (int k = count(random); k > 0; --k) {
      seen.emplace_back(kSide * unit(random), kSide * unit(random));
    }
    state = step(tracker, std::move(state), seen_at(i, seen));
    sum += state.log_likelihood;
  }
  return sum;
}

// Property: the likelihood is greatest near what is true; 200 scans tell P_D = 0.8 from 0.5 and
// 0.95, and 5 false detections from 2.5 and 10 (by tens of nats).
TEST(Existence, LikelihoodPrefersTheTruth) {
  for (const Association association :
       {Association::kNearestGlobal, Association::kProbabilistic, Association::kMultiScan}) {
    const double truth = log_likelihood(association, 0.8, 5.0);
    EXPECT_GT(truth, log_likelihood(association, 0.5, 5.0));
    EXPECT_GT(truth, log_likelihood(association, 0.95, 5.0));
    EXPECT_GT(truth, log_likelihood(association, 0.8, 2.5));
    EXPECT_GT(truth, log_likelihood(association, 0.8, 10.0));
  }
}

}  // namespace
}  // namespace ghtrack

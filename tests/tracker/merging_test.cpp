#include "tracker/merging.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/tracker/scans.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kSigma = 0.5;

TrackerDesign design(int scans) {
  TrackerConfig config;
  config.life_cycle = LifeCycle::kCounts;
  config.merge.scans = scans;
  KalmanCvConfig filter;
  filter.model = process::PiecewiseConstant{.process_noise = 1.0};
  config.filters["default"] = filter;
  return {config, {{.period = 1.0, .sigma = kSigma, .field_of_view = {}}}};
}

Scan scan_of(double time, const std::vector<Vector2d>& positions) {
  return testing::scan_of(time, positions, kSigma);
}

Vector2d noise(std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, kSigma);
  const double x = normal(random);
  const double y = normal(random);
  return {x, y};
}

/// A target that is seen twice in each scan for a while makes two confirmed tracks.
TrackerState seen_twice(const TrackerDesign& tracker, std::mt19937& random) {
  TrackerState state;
  for (int i = 0; i < 8; ++i) {
    const Vector2d truth(2.0 * i, 0.0);
    const Vector2d first = truth + noise(random);
    const Vector2d second = truth + noise(random);
    state = step(tracker, std::move(state), scan_of(i, {first, second}));
  }
  return state;
}

/// The same target seen once.
void see_once(const TrackerDesign& tracker, TrackerState& state, int from, int to,
              std::mt19937& random) {
  for (int i = from; i < to; ++i) {
    const Vector2d seen = Vector2d(2.0 * i, 0.0) + noise(random);
    state = step(tracker, std::move(state), scan_of(i, {seen}));
  }
}

int confirmed(const TrackerState& state) {
  return static_cast<int>(
      std::count_if(state.tracks.begin(), state.tracks.end(),
                    [](const Track& track) { return track.status != TrackStatus::kTentative; }));
}

// Property: of two tracks that share the detections of one target the older stays.
TEST(Merging, EndsTheYoungerOfTwoTracksOfOneTarget) {
  int ended_by_merging = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const TrackerDesign tracker = design(3);
    std::mt19937 random(seed);
    TrackerState state = seen_twice(tracker, random);
    if (confirmed(state) != 2) continue;
    const int oldest = state.tracks.front().id;
    see_once(tracker, state, 8, 11, random);
    if (confirmed(state) == 1 && state.tracks.front().id == oldest) ++ended_by_merging;
    see_once(tracker, state, 11, 20, random);
    EXPECT_EQ(confirmed(state), 1) << seed;
  }
  EXPECT_GE(ended_by_merging, 20);
}

// Derived: with the rule off both live while each gets a detection in five scans.
TEST(Merging, IsOffWithNoScans) {
  const TrackerDesign never = design(0);
  std::mt19937 random(1);
  TrackerState state = seen_twice(never, random);
  ASSERT_EQ(confirmed(state), 2);
  see_once(never, state, 8, 11, random);
  EXPECT_EQ(confirmed(state), 2);
}

// Property: two targets side by side, each seen, stay two, however near.
TEST(Merging, LeavesTwoTargetsThatAreBothSeen) {
  const TrackerDesign tracker = design(3);
  std::mt19937 random(5);
  TrackerState state;
  for (int i = 0; i < 200; ++i) {
    const Vector2d left = Vector2d(2.0 * i, 0.0) + noise(random);
    const Vector2d right = Vector2d(2.0 * i, 1.0) + noise(random);
    state = step(tracker, std::move(state), scan_of(i, {left, right}));
  }
  ASSERT_EQ(confirmed(state), 2);
  EXPECT_EQ(state.tracks[0].id, 1);
  EXPECT_EQ(state.tracks[1].id, 2);
}

// Property: two targets that cross with a missed detection now and then stay two.
TEST(Merging, LeavesTwoTargetsThatCross) {
  const TrackerDesign tracker = design(5);
  std::uniform_real_distribution<double> unit;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    TrackerState state;
    for (int i = -15; i <= 15; ++i) {
      std::vector<Vector2d> seen;
      for (const double side : {-1.0, 1.0}) {
        const Vector2d position = Vector2d(2.0 * i, side * i) + noise(random);
        if (i < 0 || unit(random) < 0.9) seen.push_back(position);
      }
      state = step(tracker, std::move(state), scan_of(i + 15, seen));
    }
    EXPECT_EQ(confirmed(state), 2) << seed;
  }
}

}  // namespace
}  // namespace ghtrack

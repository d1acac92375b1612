#include "tracker/tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/tracker/scans.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kSigma = 0.5;
constexpr double kPeriod = 0.1;

/// A tracker that counts hits and misses.
TrackerDesign design(TrackerConfig config = {}, SensorTraits sensor = {}) {
  config.life_cycle = LifeCycle::kCounts;
  if (config.filters.empty()) config.filters["default"] = GhConfig{};
  sensor.period = kPeriod;
  sensor.sigma = kSigma;
  return {std::move(config), {sensor}};
}

Scan scan_of(double time, const std::vector<Vector2d>& positions) {
  return testing::scan_of(time, positions, kSigma);
}

TrackerState follow(const TrackerDesign& tracker, const std::vector<Scan>& scans) {
  TrackerState state;
  for (const Scan& scan : scans) state = step(tracker, std::move(state), scan);
  return state;
}

/// Targets in steady motion seen with noise, one in ten detections missing, some clutter.
std::vector<Scan> busy_scans(int count, const Vector2d& shift) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit;
  std::vector<Scan> scans;
  for (int i = 0; i < count; ++i) {
    std::vector<Vector2d> seen;
    for (int target = 0; target < 8; ++target) {
      const Vector2d truth(10.0 * target + 2.0 * kPeriod * i, 5.0 * (target % 3) - kPeriod * i);
      const Vector2d noise(normal(random), normal(random));
      if (unit(random) < 0.9) seen.push_back(truth + kSigma * noise + shift);
    }
    const Vector2d clutter(100.0 * unit(random), 20.0 * unit(random));
    seen.push_back(clutter + shift);
    scans.push_back(scan_of(kPeriod * i, seen));
  }
  return scans;
}

std::vector<Vector2d> confirmed_positions(const TrackerState& state) {
  std::vector<Vector2d> positions;
  for (const TrackEstimate& track : snapshot(state).tracks) {
    if (track.status != TrackStatus::kTentative) positions.push_back(track.position);
  }
  std::sort(positions.begin(), positions.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
  return positions;
}

// Derived: 3 hits of 5 scans confirm; the first two detections do not.
TEST(Tracker, ConfirmsATrackAtItsThirdHit) {
  const TrackerDesign tracker = design();
  TrackerState state;
  std::vector<TrackStatus> statuses;
  for (int i = 0; i < 4; ++i) {
    state = step(tracker, std::move(state), scan_of(kPeriod * i, {Vector2d(i * 0.1, 0)}));
    ASSERT_EQ(state.tracks.size(), 1U);
    statuses.push_back(state.tracks.front().status);
  }
  using enum TrackStatus;
  EXPECT_EQ(statuses, (std::vector{kTentative, kTentative, kConfirmed, kConfirmed}));
}

// Derived: a confirmed track coasts through 4 misses and ends at the 5th, a tentative one ends at
// the second.
TEST(Tracker, CoastsThroughMissesAndThenLetsGo) {
  const TrackerDesign tracker = design();
  TrackerState confirmed =
      follow(tracker, {scan_of(0, {Vector2d(0, 0)}), scan_of(0.1, {Vector2d(1, 0)}),
                       scan_of(0.2, {Vector2d(2, 0)})});
  for (int miss = 1; miss <= 4; ++miss) {
    confirmed = step(tracker, std::move(confirmed), scan_of(0.2 + 0.1 * miss, {}));
    ASSERT_EQ(confirmed.tracks.size(), 1U);
    EXPECT_EQ(confirmed.tracks.front().status, TrackStatus::kCoasting);
    EXPECT_FALSE(snapshot(confirmed).tracks.front().residual);
  }
  EXPECT_NEAR(snapshot(confirmed).tracks.front().position.x(), 6.0, 1e-9);
  confirmed = step(tracker, std::move(confirmed), scan_of(0.7, {}));
  EXPECT_TRUE(confirmed.tracks.empty());

  TrackerState tentative = follow(tracker, {scan_of(0, {Vector2d(0, 0)}), scan_of(0.1, {})});
  EXPECT_EQ(tentative.tracks.size(), 1U);
  tentative = step(tracker, std::move(tentative), scan_of(0.2, {}));
  EXPECT_TRUE(tentative.tracks.empty());
}

// Derived: misses outside the field of view say nothing; after 20 scans unseen the track ends
// anyway.
TEST(Tracker, MissesOutsideTheFieldOfViewDoNotCount) {
  TrackerConfig config;
  config.drop_unseen = 20;
  const TrackerDesign tracker =
      design(config, {.period = 1,
                      .sigma = 1,
                      .field_of_view = Eigen::AlignedBox2d(Vector2d(-5, -5), Vector2d(5, 5))});
  TrackerState state;
  for (int i = 0; i <= 5; ++i) {
    state = step(tracker, std::move(state), scan_of(kPeriod * i, {Vector2d(i, 0)}));
  }
  for (int i = 6; i <= 24; ++i) {
    state = step(tracker, std::move(state), scan_of(kPeriod * i, {}));
    ASSERT_EQ(state.tracks.size(), 1U);
  }
  state = step(tracker, std::move(state), scan_of(2.5, {}));
  EXPECT_TRUE(state.tracks.empty());
}

// Property: a track that goes below the floor ends as if it were in view; one that goes as far
// aside lives on, and so does one that is still above the floor.
TEST(Tracker, NothingHidesBelowTheFloor) {
  TrackerConfig counts, existence, hypotheses;
  counts.life_cycle = LifeCycle::kCounts;
  existence.life_cycle = hypotheses.life_cycle = LifeCycle::kExistence;
  hypotheses.association = Association::kMultiScan;
  for (TrackerConfig config : {counts, existence, hypotheses}) {
    const auto scans_to_let_go = [&](const Vector2d& velocity, double floor) {
      config.filters["default"] = GhConfig{};
      config.drop_unseen = 1000;
      config.floor = floor;
      const TrackerDesign tracker(
          config, {{.period = kPeriod,
                    .sigma = kSigma,
                    .field_of_view = Eigen::AlignedBox2d(Vector2d(-20, 0), Vector2d(6, 30))}});
      TrackerState state;
      for (int i = -30; i <= 0; ++i) {
        state = step(tracker, std::move(state),
                     scan_of(kPeriod * i, {Vector2d(5, 1) + kPeriod * i * velocity}));
      }
      int misses = 0;
      while (!state.tracks.empty() && misses < 30) {
        state = step(tracker, std::move(state), scan_of(kPeriod * ++misses, {}));
      }
      return misses;
    };
    const Vector2d down(0, -6), aside(6, 0);
    EXPECT_LT(scans_to_let_go(down, 0.0), 12);
    EXPECT_EQ(scans_to_let_go(aside, 0.0), 30);
    EXPECT_EQ(scans_to_let_go(down, -100.0), 30);
  }
}

// Property: the world has no preferred origin; 1024 m is exact in binary, so only rounding differs.
TEST(Tracker, ShiftingTheWorldShiftsTheTracks) {
  const TrackerDesign tracker = design();
  const Vector2d shift(1024.0, -512.0);
  const auto here = confirmed_positions(follow(tracker, busy_scans(60, Vector2d::Zero())));
  const auto there = confirmed_positions(follow(tracker, busy_scans(60, shift)));
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_NEAR((there[i] - here[i] - shift).norm(), 0.0, 1e-9);
  }
}

// Derived: a scan from the past and detections that are not finite are refused and counted.
TEST(Tracker, RefusesAndCountsWhatItCannotUse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const TrackerDesign tracker = design();
  TrackerState state =
      follow(tracker, {scan_of(1.0, {Vector2d(0, 0), Vector2d(nan, 0), Vector2d(0, infinity)}),
                       scan_of(0.5, {Vector2d(1, 1)}), scan_of(nan, {}), scan_of(infinity, {})});
  EXPECT_EQ(state.tracks.size(), 1U);
  EXPECT_EQ(state.scans_refused, 3);
  EXPECT_EQ(state.detections_refused, 2);
}

// Derived: only who simulates knows whose detection it is; the tracker cannot be asked for it.
TEST(Tracker, CannotKnowWhoIsWho) {
  TrackerConfig config;
  config.association = Association::kKnown;
  EXPECT_THROW(design(config), std::invalid_argument);
}

}  // namespace
}  // namespace ghtrack

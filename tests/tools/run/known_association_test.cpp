#include "tools/run/known_association.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kPeriod = 0.1;

TrackerDesign design(LateScans late_scans = LateScans::kRefuse) {
  TrackerConfig config;
  config.association = Association::kKnown;
  config.late_scans = late_scans;
  return design_for_one_object(config, {{.period = kPeriod, .sigma = 0.5, .field_of_view = {}}});
}

Observation seen(double time, const std::vector<std::pair<ObjectId, Vector2d>>& objects) {
  Observation observation{.scan = {.time = time, .sensor = 0, .detections = {}}, .origins = {}};
  for (const auto& [object, position] : objects) {
    observation.scan.detections.push_back(
        {.position = position, .covariance = 0.25 * Eigen::Matrix2d::Identity(), .label = {}});
    observation.origins.push_back(object);
  }
  return observation;
}

/// Four targets on crossing lines, each seen in nine of ten scans, and clutter.
std::vector<Observation> crossing() {
  std::mt19937 engine(3);
  const auto uniform = [&] { return static_cast<double>(engine()) / 4294967296.0; };
  std::vector<Observation> all;
  for (int i = -40; i <= 40; ++i) {
    std::vector<std::pair<ObjectId, Vector2d>> objects{{kClutterOrigin, {5 * uniform(), -20.0}}};
    for (int k = 0; k < 4; ++k) {
      if (uniform() > 0.9) continue;
      objects.push_back({k, {(k % 2 == 0 ? 0.2 : -0.2) * i, 0.05 * (k - 1.5) * i + uniform()}});
    }
    all.push_back(seen(kPeriod * (i + 40), objects));
  }
  return all;
}

// Property: each detection used is of one object per track, through every crossing; detections keep
// their places in the whole scan; clutter has no track.
TEST(KnownAssociation, FollowsEachObjectThroughACrossing) {
  const TrackerDesign tracker = design();
  KnownState state;
  std::map<int, ObjectId> owner;  // of a track
  for (const Observation& observation : crossing()) {
    state = step(tracker, std::move(state), observation);
    const TrackSnapshot now = snapshot(state);
    EXPECT_TRUE(std::is_sorted(now.tracks.begin(), now.tracks.end(),
                               [](const auto& a, const auto& b) { return a.id < b.id; }));
    for (const TrackEstimate& track : now.tracks) {
      if (!track.detection) continue;
      const ObjectId object = observation.origins.at(*track.detection);
      EXPECT_NE(object, kClutterOrigin);
      EXPECT_EQ(owner.try_emplace(track.id, object).first->second, object);
    }
  }
  ASSERT_EQ(snapshot(state).tracks.size(), 4U);
  EXPECT_EQ(state.trackers.size(), 4U);
}

// Derived: five misses end a track; the object's next detection starts one with a new id.
TEST(KnownAssociation, StartsAnewAfterALoss) {
  const TrackerDesign tracker = design();
  KnownState state;
  int i = 0;
  const auto show = [&](bool is_seen) {
    state = step(tracker, std::move(state),
                 is_seen ? seen(kPeriod * i, {{7, Vector2d(0.1 * i, 0)}}) : seen(kPeriod * i, {}));
    ++i;
  };
  for (int hit = 0; hit < 5; ++hit) show(true);
  EXPECT_EQ(snapshot(state).tracks.at(0).id, 1);
  for (int miss = 0; miss < 5; ++miss) show(false);
  EXPECT_TRUE(snapshot(state).tracks.empty());
  show(true);
  EXPECT_EQ(snapshot(state).tracks.at(0).id, 2);
}

// Property: late observations, worked in where they belong, leave what the run in order leaves.
TEST(KnownAssociation, ReplaysLateObservations) {
  const TrackerDesign tracker = design(LateScans::kReplay);
  std::vector<Observation> all = crossing();
  KnownReplayState in_order, late;
  for (const Observation& observation : all) in_order = step(tracker, in_order, observation);
  for (std::size_t i = 0; i + 4 < all.size(); i += 5) std::swap(all[i], all[i + 4]);
  int replayed = 0;
  for (const Observation& observation : all) {
    late = step(tracker, late, observation);
    replayed += late.fate == ScanFate::kReplayed;
  }
  EXPECT_GE(replayed, 30);
  EXPECT_EQ(late.arrivals.at(0).replayed, replayed);
  const TrackSnapshot a = snapshot(in_order.now);
  const TrackSnapshot b = snapshot(late.now);
  ASSERT_EQ(a.tracks.size(), b.tracks.size());
  for (std::size_t i = 0; i < a.tracks.size(); ++i) {
    EXPECT_EQ(a.tracks[i].id, b.tracks[i].id);
    EXPECT_EQ(a.tracks[i].position, b.tracks[i].position);
  }
}

// Derived: what has no finite place is refused and counted, whoever made it.
TEST(KnownAssociation, CountsWhatItCannotUse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TrackerDesign tracker = design();
  KnownState state = step(tracker, {}, seen(1.0, {{0, {0, 0}}, {1, {nan, 0}}, {-1, {0, nan}}}));
  EXPECT_EQ(state.detections_refused, 2);
  EXPECT_EQ(snapshot(state).tracks.size(), 1U);
  state = step(tracker, std::move(state), seen(0.5, {{0, {0, 0}}}));
  EXPECT_EQ(state.fate, ScanFate::kRefused);
}

}  // namespace
}  // namespace ghtrack

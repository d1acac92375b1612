// Tracking while learning.

#include "tools/run/online.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "tests/tools/run/recorded.hpp"
#include "tests/tracker/learning/scene.hpp"

namespace ghtrack {
namespace {

struct Followed {
  std::vector<TrackSnapshot> snapshots;
  std::vector<LearnedConfig> learned;
  TrackerState state;
};

Followed followed(const std::vector<Scan>& scans, const OfflineConfig& config = {}) {
  Followed result;
  result.state = track_online(
      config, recorded(scans),
      [&](const TrackSnapshot& now, const Scan&) { result.snapshots.push_back(now); },
      [&](const LearnedConfig& now) { result.learned.push_back(now); });
  return result;
}

OfflineConfig with(Association association) {
  OfflineConfig config;
  config.tracker.association = association;
  return config;
}

// Property: what is said of a scan does not depend on what comes after it.
TEST(Online, SaysNothingWithHindsight) {
  const std::vector<Scan> scans = LearningScene{}.record(4);
  const Followed all = followed(scans);
  const Followed part = followed({scans.begin(), scans.begin() + 47});
  ASSERT_EQ(part.snapshots.size(), 47U);
  for (std::size_t i = 0; i < part.snapshots.size(); ++i) {
    ASSERT_EQ(part.snapshots[i].tracks.size(), all.snapshots[i].tracks.size()) << i;
    for (std::size_t j = 0; j < part.snapshots[i].tracks.size(); ++j) {
      EXPECT_EQ(part.snapshots[i].tracks[j].id, all.snapshots[i].tracks[j].id);
      EXPECT_EQ(part.snapshots[i].tracks[j].position, all.snapshots[i].tracks[j].position);
    }
  }
}

// Property: whenever more is learned, everything is tracked anew with it, so that after it the
// tracks are those of a tracker that has been told so from the first scan on; ids apart.
TEST(Online, EndsAsATrackerThatWasToldSo) {
  for (const Association association : {Association::kNearestGlobal, Association::kMultiScan}) {
    const std::vector<Scan> scans = LearningScene{}.record(6);
    const Followed online = followed(scans, with(association));
    ASSERT_FALSE(online.learned.empty());
    const TrackerState told = track_offline(online.learned.back().config, recorded(scans),
                                            [](const TrackSnapshot&, const Scan&) {});
    ASSERT_EQ(online.state.tracks.size(), told.tracks.size());
    for (std::size_t i = 0; i < told.tracks.size(); ++i) {
      EXPECT_EQ(estimate(online.state.tracks[i].filter).position,
                estimate(told.tracks[i].filter).position);
      EXPECT_EQ(online.state.tracks[i].existence, told.tracks[i].existence);
      EXPECT_EQ(online.state.tracks[i].id > 0, told.tracks[i].id > 0);
    }
  }
}

// Property: ids stay what they are when more is learned, none is given twice, and targets that are
// far from each other keep theirs from the first time on.
TEST(Online, TracksKeepTheirIds) {
  LearningScene scene;
  scene.targets = 3;
  scene.clutter = 2.0;
  scene.detection_probability = 0.95;
  for (const Association association : {Association::kNearestGlobal, Association::kMultiScan}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Followed online = followed(scene.record(seed), with(association));
      EXPECT_GE(online.learned.size(), 5U);
      std::map<int, int> seen;
      for (const TrackSnapshot& now : online.snapshots) {
        std::set<int> ids;
        for (const TrackEstimate& track : now.tracks) {
          EXPECT_TRUE(ids.insert(track.id).second) << "twice: " << track.id;
          if (track.status != TrackStatus::kTentative) ++seen[track.id];
        }
      }
      const auto lasting = std::count_if(seen.begin(), seen.end(),
                                         [](const auto& track) { return track.second > 50; });
      EXPECT_EQ(lasting, 3) << "seed " << seed;
    }
  }
}

// Property: what is said is believed from the first scan that is learned from.
TEST(Online, BelievesWhatIsSaid) {
  OfflineConfig said;
  said.noise = 1.0;
  said.clutter = 8.0;
  const Followed online = followed(LearningScene{}.record(8), said);
  for (const LearnedConfig& learned : online.learned) {
    EXPECT_EQ(learned.config.noise, 1.0);
    EXPECT_EQ(learned.config.clutter, 8.0);
  }
}

// Property: nothing in, nothing out.
TEST(Online, SurvivesDataWithoutAnything) {
  EXPECT_TRUE(followed({}).snapshots.empty());
  std::vector<Scan> empty;
  for (int i = 0; i < 40; ++i) empty.push_back({.time = 1.0 * i, .sensor = 0, .detections = {}});
  const Followed online = followed(empty);
  ASSERT_EQ(online.snapshots.size(), 40U);
  EXPECT_TRUE(online.state.tracks.empty());
}

}  // namespace
}  // namespace ghtrack

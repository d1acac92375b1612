#include "tools/run/offline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tools/data/scan_reader.hpp"
#include "tools/metrics/point_scoring.hpp"

namespace ghtrack {
namespace {

OfflineConfig reference_tracker() {
  OfflineConfig config;
  config.noise = 2.0;
  config.tracker.gate = 3.0;
  config.tracker.confirm = HitRule{.hits = 3, .scans = 64};
  config.tracker.drop_tentative = MissRule{.misses = 2, .scans = 2};
  config.tracker.drop_confirmed = MissRule{.misses = 4, .scans = 4};
  KalmanCvConfig filter;
  filter.model.emplace<process::WhiteNoise<1>>().spectral_density = 0.05;
  filter.initial_speed = 3.0;
  config.tracker.filters["default"] = filter;
  return config;
}

/// The same tracker with g-h filters designed for the same process noise.
OfflineConfig designed_tracker(std::optional<GainSource> schedule) {
  OfflineConfig config = reference_tracker();
  GhConfig filter;
  filter.design = gain_design::TrackingIndex<1>{
      .process_noise = std::sqrt(0.05), .index = std::nullopt, .model = ProcessModel::kWhiteNoise};
  filter.schedule = schedule;
  filter.initial_speed = 3.0;
  config.tracker.filters["default"] = filter;
  return config;
}

struct Reference {
  const char* name;
  double gospa;
  int id_switches;
};

class SetA : public ::testing::TestWithParam<Reference> {};

ScoreResult score_of(const char* name, const OfflineConfig& config) {
  const std::string stem = std::string(GHTRACK_SOURCE_DIR) + "/tests/reference/tracking/" + name;
  const DetectionTable detections = read_detections_csv(stem + "_detections.csv");
  std::vector<IdentifiedPoint> tracks;
  track_offline(config, detections.scans, [&](const TrackSnapshot& snapshot, const Scan&) {
    for (const TrackEstimate& track : snapshot.tracks) {
      if (track.status == TrackStatus::kTentative) continue;
      tracks.push_back({.time = snapshot.time, .id = track.id, .position = track.position});
    }
  });
  ScoreOptions options;
  options.gospa.cutoff = 10.0;
  return score_points(read_truth_csv(stem + "_truth.csv"), tracks, options);
}

// Recorded: mean GOSPA of Stone Soup's tracker with the same logic, see the README of the folder.
TEST_P(SetA, TheKalmanTrackerScoresAsTheReferenceDoes) {
  const ScoreResult result = score_of(GetParam().name, reference_tracker());
  EXPECT_NEAR(result.gospa, GetParam().gospa, 1e-4);
  EXPECT_EQ(result.mot.clear.id_switches, GetParam().id_switches);
}

// Derived: gains that follow the predicted error are Kalman's.
TEST_P(SetA, TheDesignedTrackerScoresAsTheKalmanTracker) {
  const ScoreResult result = score_of(GetParam().name, designed_tracker(std::nullopt));
  EXPECT_NEAR(result.gospa, GetParam().gospa, 1e-4);
  EXPECT_EQ(result.mot.clear.id_switches, GetParam().id_switches);
}

// Property: the textbook's gains, with a table for the start and for misses, come within 4 % of the
// Kalman filter and lose no more than twice as many identities.
TEST_P(SetA, TheTextbookTrackerComesCloseToTheKalmanTracker) {
  const ScoreResult result = score_of(GetParam().name, designed_tracker(GainSource::kTable));
  EXPECT_LT(result.gospa, 1.04 * GetParam().gospa);
  EXPECT_LE(result.mot.clear.id_switches, 2 * GetParam().id_switches);
}

INSTANTIATE_TEST_SUITE_P(Reference, SetA,
                         ::testing::Values(Reference{"A_n10", 6.1790, 0},
                                           Reference{"A_n50", 14.3874, 1},
                                           Reference{"A_n100", 20.4130, 5},
                                           Reference{"A_n200", 29.3608, 12}));

Scan scan_at(double time, double x) {
  return {.time = time,
          .sensor = 0,
          .detections = {
              {.position = {x, 0.0}, .covariance = Eigen::Matrix2d::Identity(), .label = {}}}};
}

// Property: a gap of two thousand million frames costs no more than the tracks take to end.
TEST(Offline, AGapIsCrossedInAFewEmptyScans) {
  int snapshots = 0;
  const std::vector<Scan> scans = {scan_at(1, 0), scan_at(2, 1), scan_at(3, 2), scan_at(2e9, 3)};
  track_offline({}, scans, [&](const TrackSnapshot&, const Scan&) { ++snapshots; });
  EXPECT_LT(snapshots, 20);
}

// Derived: two missing scans are two misses, then the track goes on.
TEST(Offline, MissingScansCountAsMisses) {
  std::vector<TrackSnapshot> snapshots;
  const std::vector<Scan> scans = {scan_at(0, 0), scan_at(1, 1), scan_at(2, 2), scan_at(5, 5)};
  track_offline({}, scans,
                [&](const TrackSnapshot& snapshot, const Scan&) { snapshots.push_back(snapshot); });
  ASSERT_EQ(snapshots.size(), 6U);
  EXPECT_EQ(snapshots[3].tracks.at(0).status, TrackStatus::kCoasting);
  EXPECT_EQ(snapshots[5].tracks.at(0).status, TrackStatus::kConfirmed);
  EXPECT_EQ(snapshots[5].tracks.at(0).id, snapshots[2].tracks.at(0).id);
}

}  // namespace
}  // namespace ghtrack

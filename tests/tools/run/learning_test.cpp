// What is learned from recorded scans, and that tracking with it needs nothing else.

#include "tools/run/learning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "tests/tools/run/recorded.hpp"
#include "tests/tracker/learning/scene.hpp"

namespace ghtrack {
namespace {

std::vector<Scan> scaled(std::vector<Scan> scans, double length, double time) {
  for (Scan& scan : scans) {
    scan.time *= time;
    for (Detection& detection : scan.detections) detection.position *= length;
  }
  return scans;
}

std::vector<TrackEstimate> tracked(const OfflineConfig& config, const std::vector<Scan>& scans) {
  std::vector<TrackEstimate> tracks;
  track_offline(config, recorded(scans), [&](const TrackSnapshot& now, const Scan&) {
    tracks.insert(tracks.end(), now.tracks.begin(), now.tracks.end());
  });
  return tracks;
}

class Units : public ::testing::TestWithParam<std::tuple<double, double, double>> {};

// Property: there are no units. Lengths and times that are multiplied by constants give the same
// tracks multiplied by them: exactly by powers of two, by others up to rounding.
TEST_P(Units, ChangeNothingButTheScale) {
  const auto [length, time, error] = GetParam();
  const std::vector<Scan> scans = LearningScene{}.record(7);
  const std::vector<Scan> others = scaled(scans, length, time);
  const OfflineConfig learned = learn_offline({}, recorded(scans)).config;
  const OfflineConfig also_learned = learn_offline({}, recorded(others)).config;
  EXPECT_NEAR(*also_learned.noise / (*learned.noise * length), 1.0, error);
  EXPECT_NEAR(*also_learned.area / (*learned.area * length * length), 1.0, error);
  EXPECT_NEAR(also_learned.period / (learned.period * time), 1.0, error);
  const std::vector<TrackEstimate> tracks = tracked(learned, scans);
  const std::vector<TrackEstimate> same = tracked(also_learned, others);
  ASSERT_EQ(same.size(), tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    EXPECT_EQ(same[i].id, tracks[i].id);
    EXPECT_EQ(same[i].status, tracks[i].status);
    EXPECT_NEAR(*same[i].existence, *tracks[i].existence, error);
    EXPECT_LE((same[i].position - length * tracks[i].position).norm(), error * length);
    EXPECT_LE((same[i].velocity - length / time * tracks[i].velocity).norm(),
              error * length / time);
  }
}

INSTANTIATE_TEST_SUITE_P(Exactly, Units,
                         ::testing::Values(std::tuple(1024.0, 0.0625, 1e-9),
                                           std::tuple(1.0 / 4096.0, 32.0, 1e-9)));
INSTANTIATE_TEST_SUITE_P(UpToRounding, Units,
                         ::testing::Values(std::tuple(1000.0, 0.04, 1e-3),
                                           std::tuple(1e-5, 3600.0, 1e-3)));

class Speeds : public ::testing::TestWithParam<double> {};

// Property: a target is one track however far it goes from scan to scan, beside its noise: ships
// and aircraft whose positions are as good as exact.
TEST_P(Speeds, AreFollowedWithOneTrackEach) {
  const LearningScene scene{.targets = 2,
                            .noise_x = 5.0 / GetParam(),
                            .noise_y = 5.0 / GetParam(),
                            .process_density = 0.0,
                            .detection_probability = 1.0,
                            .clutter = 0.0,
                            .side = 4000.0};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const LearnedTracker learned = learn_offline({}, recorded(scene.record(seed))).learned;
    EXPECT_EQ(learned.tracks, scene.targets) << seed;
    EXPECT_GT(learned.explained, 0.95) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(BesideTheNoise, Speeds,
                         ::testing::Values(2.0, 20.0, 200.0, 2e3, 2e4, 1e6));

/// One target that is seen at whole numbers, wherever it is.
std::vector<Scan> seen_at_whole_numbers(double speed) {
  std::vector<Scan> scans;
  for (int i = 0; i < 60; ++i) {
    Detection detection;
    detection.position = {std::round(speed * i), 10.0 * i};
    detection.covariance.setZero();
    scans.push_back({.time = 1.0 * i, .sensor = 0, .detections = {detection}});
  }
  return scans;
}

// Property: whole numbers that a rounded path jumps between have the error of rounding, 1/√12;
// those of a path that is 3 m further on every time have none.
TEST(LearnedConfig, TellsRoundingFromMotion) {
  for (const double speed : {0.05, 0.37, 2.6}) {
    const LearnedTracker learned =
        learn_offline({}, recorded(seen_at_whole_numbers(speed))).learned;
    EXPECT_GT(learned.sensors[0].noise.x.value, 0.28) << speed;
    EXPECT_LT(learned.sensors[0].noise.x.value, 0.5) << speed;
    EXPECT_LT(learned.sensors[0].noise.y.value, 0.01) << speed;
  }
  for (const double speed : {3.0, 20.0}) {
    const LearnedTracker learned =
        learn_offline({}, recorded(seen_at_whole_numbers(speed))).learned;
    EXPECT_LT(learned.sensors[0].noise.x.value, 0.01) << speed;
  }
}

// Property: what is learned leaves nothing open, and learning again from it changes nothing.
TEST(LearnedConfig, SaysAllThatThereIsToSay) {
  const std::vector<Scan> scans = LearningScene{}.record(2);
  EXPECT_TRUE(leaves_open({}, {""}, false));
  const LearnedConfig learned = learn_offline({}, recorded(scans));
  EXPECT_FALSE(leaves_open(learned.config, {""}, false));
  const OfflineConfig again = learn_offline(learned.config, recorded(scans)).config;
  EXPECT_EQ(again.noise, learned.config.noise);
  EXPECT_EQ(again.detection_probability, learned.config.detection_probability);
  EXPECT_EQ(again.clutter, learned.config.clutter);
}

// Property: what is said is not learned.
TEST(LearnedConfig, KeepsWhatIsSaid) {
  OfflineConfig said;
  said.noise = 1.25;
  said.detection_probability = 0.8;
  said.clutter = 6.0;
  const LearnedConfig learned = learn_offline(said, recorded(LearningScene{}.record(3)));
  EXPECT_EQ(learned.config.noise, said.noise);
  EXPECT_EQ(learned.config.detection_probability, said.detection_probability);
  EXPECT_EQ(learned.config.clutter, said.clutter);
  EXPECT_TRUE(learned.learned.sensors[0].noise.x.is_given);
  EXPECT_GT(learned.learned.classes.at("default").process_density.value, 0.0);
}

// Property: the intervals that are printed hold the true values. Of 5 · 20 intervals 95 do where
// all detections are known to be whose they are; fewer than 85 would then be seen once in 10 000
// times.
TEST(LearnedConfig, IntervalsHoldTheTrueValues) {
  const LearningScene scene{.noise_x = 2.0, .noise_y = 1.0};
  int held = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const LearnedTracker learned = learn_offline({}, recorded(scene.record(seed))).learned;
    const auto holds = [](const Learned& number, double truth) {
      return number.low <= truth && truth <= number.high ? 1 : 0;
    };
    const LearnedSensor& sensor = learned.sensors[0];
    held += holds(sensor.noise.x, scene.noise_x) + holds(sensor.noise.y, scene.noise_y) +
            holds(sensor.detection_probability, scene.detection_probability) +
            holds(sensor.clutter, scene.clutter) +
            holds(learned.classes.at("default").process_density, scene.process_density);
  }
  EXPECT_GE(held, 85);
}

}  // namespace
}  // namespace ghtrack

#include "tracker/learning/learning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "tests/tracker/learning/scene.hpp"

namespace ghtrack {
namespace {

LearnedTracker learned_from(const std::vector<Scan>& scans, double period) {
  const std::vector<SensorSaid> sensors{{.period = period,
                                         .noise = {},
                                         .field_of_view = {},
                                         .detection_probability = {},
                                         .clutter = {}}};
  return learn({}, sensors, scans);
}

// Property: learned values lie near the true ones, which nobody has said. Of 4 · 80 detections the
// relative errors are below 10 %, three times their standard deviation for the noise.
TEST(Learning, FindsWhatNobodyHasSaid) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const LearningScene scene;
    const LearnedTracker learned = learned_from(scene.record(seed), scene.period);
    ASSERT_EQ(learned.sensors.size(), 1U);
    const LearnedSensor& sensor = learned.sensors[0];
    EXPECT_NEAR(sensor.noise.x.value, 1.0, 0.15);
    EXPECT_NEAR(sensor.noise.y.value, 1.0, 0.15);
    EXPECT_NEAR(sensor.detection_probability.value, 0.9, 0.06);
    EXPECT_NEAR(sensor.clutter.value, 8.0, 1.2);
    EXPECT_NEAR(std::log(learned.classes.at("default").process_density.value), std::log(0.05), 1.0);
  }
}

// Property: few or many targets, slow or fast for their noise, among few or many false detections:
// the scales are found. Their standard error is below 10 % where targets have 80 detections or
// more.
TEST(Learning, FindsTheScalesOfAllKindsOfScenes) {
  std::mt19937 random(3);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>()(random));
  };
  for (unsigned seed = 1; seed <= 30; ++seed) {
    LearningScene scene;
    scene.noise_x = scene.noise_y = between(0.1, 10.0);
    scene.targets = static_cast<int>(between(2.0, 20.0));
    scene.speed = scene.noise_x * between(0.5, 10.0);
    scene.process_density = scene.noise_x * scene.noise_x * between(0.002, 0.1);
    scene.detection_probability = between(0.6, 0.98);
    scene.clutter = between(0.1, 20.0);
    scene.side = scene.noise_x * between(200.0, 800.0);
    const LearnedTracker learned = learned_from(scene.record(seed), scene.period);
    EXPECT_NEAR(std::log(learned.sensors[0].noise.x.value / scene.noise_x), 0.0, 0.35) << seed;
    EXPECT_NEAR(learned.sensors[0].detection_probability.value, scene.detection_probability, 0.1)
        << seed;
  }
}

// Property: what stands still, to the digit, is a target like another, alone or beside one that
// moves, and tells nothing of the noise; so is one that stops on its way.
TEST(Learning, FollowsWhatIsParked) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto scans_of = [&](int parked_from, int parked_until, bool has_other) {
    std::vector<Scan> scans;
    double x = 0.0;
    for (int k = 0; k < 150; ++k) {
      const bool is_parked = k >= parked_from && k < parked_until;
      if (!is_parked) x += 5.0;
      Scan& scan = scans.emplace_back();
      scan.time = k;
      const auto add = [&](double at_x, double at_y) {
        scan.detections.push_back(
            {.position = {at_x, at_y}, .covariance = Eigen::Matrix2d::Zero(), .label = {}});
      };
      if (is_parked) {
        add(x, 0.0);
      } else {
        const double error = normal(random);
        add(x + error, normal(random));
      }
      if (has_other) add(1000.0, 500.0);
    }
    return scans;
  };
  for (const auto& [from, until, has_other] :
       {std::tuple(0, 150, false), std::tuple(50, 100, false), std::tuple(70, 78, false),
        std::tuple(0, 0, true)}) {
    SCOPED_TRACE(until);
    const std::vector<Scan> scans = scans_of(from, until, has_other);
    const LearnedTracker learned = learned_from(scans, 1.0);
    EXPECT_EQ(learned.tracks, has_other ? 2 : 1);
    EXPECT_GT(learned.explained, 0.98);
    const double moving = 1.0 - (until - from) / 150.0;
    if (moving > 0.5 && !has_other) {
      EXPECT_NEAR(learned.sensors[0].noise.x.value, 1.0, 0.3);
    }
  }
}

// Property: what moves along an axis, without any error, is one target, whatever the clock shows:
// the area that it is seen in is more than the line.
TEST(Learning, FollowsWhatMovesAlongAnAxis) {
  for (const double start : {0.0, 1000.1, 1.6e9}) {
    for (const auto& [step, period, count] :
         {std::tuple(2.0, 1.0, 10), std::tuple(1.5, 0.1, 100), std::tuple(1.0, 0.04, 50)}) {
      for (const bool is_upright : {false, true}) {
        std::vector<Scan> scans;
        for (int k = 0; k < count; ++k) {
          const Eigen::Vector2d along(step * k, 3.0);
          scans.push_back({.time = start + period * k, .sensor = 0, .detections = {}});
          scans.back().detections.push_back(
              {.position = is_upright ? Eigen::Vector2d(along.reverse()) : along,
               .covariance = Eigen::Matrix2d::Zero(),
               .label = {}});
        }
        const LearnedTracker learned = learned_from(scans, period);
        EXPECT_EQ(learned.tracks, 1) << start << " " << step;
        EXPECT_GT(learned.explained, 0.98) << start << " " << step;
      }
    }
  }
}

// Property: of two sensors that see the same each has its own noise; the coarse one's detections
// are not taken for false ones.
TEST(Learning, TellsCoarseSensorsFromFineOnes) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<Scan> scans;
  for (int k = 0; k < 400; ++k) {
    const double noise = k % 2 == 0 ? 3.0 : 0.3;
    Eigen::Vector2d place(0.25 * k, 40.0 - 0.1 * k);
    place.x() += noise * normal(random);
    place.y() += noise * normal(random);
    scans.push_back({.time = 0.05 * k, .sensor = k % 2, .detections = {}});
    scans.back().detections.push_back(
        {.position = place, .covariance = Eigen::Matrix2d::Zero(), .label = {}});
  }
  const SensorSaid often{
      .period = 0.1, .noise = {}, .field_of_view = {}, .detection_probability = {}, .clutter = {}};
  const std::vector<SensorSaid> said(2, often);
  const LearnedTracker learned = learn(TrackerConfig{}, said, scans);
  ASSERT_EQ(learned.sensors.size(), 2U);
  EXPECT_NEAR(learned.sensors[0].noise.x.value, 3.0, 0.6);
  EXPECT_NEAR(learned.sensors[1].noise.x.value, 0.3, 0.06);
  for (const LearnedSensor& sensor : learned.sensors) {
    EXPECT_GT(sensor.detection_probability.value, 0.95);
    EXPECT_LT(sensor.clutter.value, 0.05);
  }
}

// Property: false detections are spread over their own area, however far targets go: only as many
// are taken for targets as chance brings together there.
TEST(Learning, FindsWhereFalseDetectionsLie) {
  LearningScene scene;
  scene.noise_x = scene.noise_y = 0.15;
  scene.side = 70.0;
  scene.clutter = 20.0;
  scene.speed = 1.2;
  scene.process_density = 5e-4;
  scene.scans = 150;
  const LearnedTracker learned = learned_from(scene.record(3), scene.period);
  const double area = scene.side * scene.side;
  EXPECT_NEAR(learned.sensors[0].area / area, 1.0, 0.3);
}

std::vector<Scan> scaled(std::vector<Scan> scans, double length, double time) {
  for (Scan& scan : scans) {
    scan.time *= time;
    for (Detection& detection : scan.detections) detection.position *= length;
  }
  return scans;
}

// Property: there are no units. Lengths and times that are multiplied by powers of two, which is
// exact, give the same numbers multiplied by them; by other numbers, up to rounding.
TEST(Learning, ScalesWithTheData) {
  const LearningScene scene;
  const std::vector<Scan> scans = scene.record(5);
  const LearnedTracker usual = learned_from(scans, 1.0);
  for (const auto& [length, time, error] :
       {std::tuple(1024.0, 0.125, 1e-12), std::tuple(1.0 / 65536.0, 64.0, 1e-12),
        std::tuple(1000.0, 0.01, 1e-3), std::tuple(1e-5, 3600.0, 1e-3)}) {
    const LearnedTracker other = learned_from(scaled(scans, length, time), time);
    const double most = error;
    const auto expect_ratio = [most](double actual, double from, double ratio) {
      EXPECT_NEAR(actual / (from * ratio), 1.0, most);
    };
    const LearnedSensor& a = usual.sensors[0];
    const LearnedSensor& b = other.sensors[0];
    expect_ratio(b.noise.x.value, a.noise.x.value, length);
    expect_ratio(b.noise.y.high, a.noise.y.high, length);
    expect_ratio(b.detection_probability.value, a.detection_probability.value, 1.0);
    expect_ratio(b.clutter.value, a.clutter.value, 1.0);
    expect_ratio(other.initial_speed, usual.initial_speed, length / time);
    expect_ratio(other.classes.at("default").process_density.value,
                 usual.classes.at("default").process_density.value,
                 length * length / (time * time * time));
    EXPECT_EQ(other.tracks, usual.tracks);
  }
}

}  // namespace
}  // namespace ghtrack

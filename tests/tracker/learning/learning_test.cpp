#include "tracker/learning/learning.hpp"

#include <gtest/gtest.h>

#include <cmath>
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
    const auto expect_ratio = [&](double actual, double from, double ratio) {
      EXPECT_NEAR(actual / (from * ratio), 1.0, error);
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

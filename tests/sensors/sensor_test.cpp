#include "sensors/sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ghtrack {
namespace {

ObjectInfo object(ObjectId id, const std::string& name, const std::string& label) {
  return {
      .id = id, .name = name, .regime = label, .label = label, .key = key_of(name), .outline = {}};
}

const std::vector<ObjectInfo> kObjects = {object(0, "a", "ball"), object(1, "b", "train")};

TruthSnapshot truth_at(double time, const std::vector<Vec2>& positions) {
  TruthSnapshot truth{.time = time, .objects = {}, .bodies = {}};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    TruthState state;
    state.id = static_cast<ObjectId>(i);
    state.position = positions[i];
    truth.objects.push_back(state);
  }
  return truth;
}

SensorConfig camera() {
  SensorConfig sensor;
  sensor.name = "camera";
  sensor.field_of_view = {Vec2(-10, -10), Vec2(110, 110)};
  return sensor;
}

const Detection* detection_of(const Observation& observation, ObjectId id) {
  const auto at = std::find(observation.origins.begin(), observation.origins.end(), id);
  return at == observation.origins.end()
             ? nullptr
             : &observation.scan.detections[at - observation.origins.begin()];
}

// Derived: mean and variance of n Gaussian errors, within 4.5 standard errors.
TEST(Sensor, NoiseHasTheStatedBiasAndSpreadOnEachAxis) {
  SensorConfig sensor = camera();
  sensor.model = PositionSensor{.noise = 0.5, .noise_y = 2.0, .bias = Vec2(0.25, -1.0)};
  constexpr int kScans = 20000;
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  Eigen::Array2d squares = Eigen::Array2d::Zero();
  for (int scan = 0; scan < kScans; ++scan) {
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), kObjects, 1);
    const Eigen::Array2d error = seen.scan.detections.at(0).position - Vec2(50, 50);
    sum += error;
    squares += error.square();
  }
  const Eigen::Array2d mean = sum / kScans;
  const Eigen::Array2d variance = squares / kScans - mean.square();
  EXPECT_NEAR(mean.x(), 0.25, 4.5 * 0.5 / std::sqrt(kScans));
  EXPECT_NEAR(mean.y(), -1.0, 4.5 * 2.0 / std::sqrt(kScans));
  EXPECT_NEAR(variance.x() / 0.25, 1.0, 4.5 * std::sqrt(2.0 / kScans));
  EXPECT_NEAR(variance.y() / 4.0, 1.0, 4.5 * std::sqrt(2.0 / kScans));
}

// Derived: binomial count of detections, Poisson count and uniform spread of clutter.
TEST(Sensor, MissesAndClutterComeAtTheStatedRates) {
  SensorConfig sensor = camera();
  sensor.detection_probability = 0.8;
  sensor.clutter = 3.0;
  constexpr int kScans = 10000;
  int detected = 0;
  int clutter = 0;
  double mean_x = 0.0;
  for (int scan = 0; scan < kScans; ++scan) {
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), kObjects, 2);
    detected += detection_of(seen, 0) != nullptr;
    for (std::size_t i = 0; i < seen.origins.size(); ++i) {
      if (seen.origins[i] != kClutterOrigin) continue;
      ++clutter;
      mean_x += seen.scan.detections[i].position.x();
    }
  }
  EXPECT_NEAR(detected, 0.8 * kScans, 4.5 * std::sqrt(kScans * 0.8 * 0.2));
  EXPECT_NEAR(clutter, 3.0 * kScans, 4.5 * std::sqrt(3.0 * kScans));
  EXPECT_NEAR(mean_x / clutter, 50.0, 4.5 * 120.0 / std::sqrt(12.0 * clutter));
}

// Property: the noise of an object depends on its name, not on who else is there.
TEST(Sensor, AddingAnObjectChangesNoOtherDetection) {
  SensorConfig sensor = camera();
  sensor.detection_probability = 0.7;
  sensor.clutter = 1.0;
  const std::vector<ObjectInfo> swapped = {object(0, "b", "train"), object(1, "a", "ball")};
  for (int scan = 0; scan < 200; ++scan) {
    const auto alone = observe(sensor, 0, scan, truth_at(0, {Vec2(10, 20)}), kObjects, 3);
    const auto both =
        observe(sensor, 0, scan, truth_at(0, {Vec2(70, 20), Vec2(10, 20)}), swapped, 3);
    const Detection* before = detection_of(alone, 0);
    const Detection* after = detection_of(both, 1);
    ASSERT_EQ(before == nullptr, after == nullptr);
    if (before == nullptr) continue;
    EXPECT_EQ(before->position, after->position);
  }
}

// Property: sorted by position, so that the order says nothing about the origin.
TEST(Sensor, DetectionsOfAScanAreOrderedByPositionAlone) {
  SensorConfig sensor = camera();
  sensor.clutter = 20.0;
  const auto seen = observe(sensor, 0, 0, truth_at(0, {Vec2(90, 0), Vec2(5, 0)}), kObjects, 4);
  EXPECT_TRUE(
      std::is_sorted(seen.scan.detections.begin(), seen.scan.detections.end(),
                     [](const auto& a, const auto& b) { return a.position.x() < b.position.x(); }));
}

// Derived: what lies outside the field of view is never seen.
TEST(Sensor, SeesNothingOutsideItsFieldOfView) {
  const auto seen = observe(camera(), 0, 0, truth_at(0, {Vec2(111, 0), Vec2(5, 0)}), kObjects, 5);
  EXPECT_EQ(seen.origins, std::vector<ObjectId>{1});
}

// Derived: binomial count of right labels; 0 means that no class is reported.
TEST(Sensor, ReportsTheRightClassWithTheStatedProbability) {
  SensorConfig sensor = camera();
  sensor.classify = 0.9;
  constexpr int kScans = 5000;
  int right = 0;
  for (int scan = 0; scan < kScans; ++scan) {
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), kObjects, 6);
    right += seen.scan.detections.at(0).label == "ball";
  }
  EXPECT_NEAR(right, 0.9 * kScans, 4.5 * std::sqrt(kScans * 0.9 * 0.1));
  sensor.classify = 0.0;
  const auto seen = observe(sensor, 0, 0, truth_at(0, {Vec2(50, 50)}), kObjects, 6);
  EXPECT_EQ(seen.scan.detections.at(0).label, "");
}

// Derived: exact instants, without accumulated rounding.
TEST(Sensor, ScansHappenAtPhasePlusIndexOverRate) {
  SensorConfig sensor = camera();
  sensor.rate = 30.0;
  sensor.phase = 0.125;
  EXPECT_EQ(scan_time(sensor, 0), 0.125);
  EXPECT_EQ(scan_time(sensor, 108000), 3600.125);
}

}  // namespace
}  // namespace ghtrack

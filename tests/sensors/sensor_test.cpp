#include "sensors/sensor.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sensors/view_geometry.hpp"
#include "sim/random.hpp"

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

Setting setting(std::uint64_t seed, const std::vector<ObjectInfo>& objects = kObjects) {
  return {.objects = objects, .classes = {"train", "ball", "balloon"}, .seed = seed};
}

PositionSensor position_sensor() {
  PositionSensor model;
  model.field_of_view = {Vec2(-10, -10), Vec2(110, 110)};
  return model;
}

SensorConfig camera() {
  SensorConfig sensor;
  sensor.name = "camera";
  sensor.model = position_sensor();
  return sensor;
}

SensorConfig radar() {
  SensorConfig sensor;
  sensor.name = "radar";
  sensor.model = Radar{};
  return sensor;
}

SensorConfig image_camera() {
  SensorConfig sensor;
  sensor.name = "image";
  sensor.model = Camera{};
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
  sensor.model =
      PositionSensor{.noise = 0.5, .noise_y = 2.0, .bias = Vec2(0.25, -1.0), .field_of_view = {}};
  constexpr int kScans = 20000;
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  Eigen::Array2d squares = Eigen::Array2d::Zero();
  for (int scan = 0; scan < kScans; ++scan) {
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(1));
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
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(2));
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
    const auto alone = observe(sensor, 0, scan, truth_at(0, {Vec2(10, 20)}), setting(3));
    const auto both =
        observe(sensor, 0, scan, truth_at(0, {Vec2(70, 20), Vec2(10, 20)}), setting(3, swapped));
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
  const auto seen = observe(sensor, 0, 0, truth_at(0, {Vec2(90, 0), Vec2(5, 0)}), setting(4));
  EXPECT_TRUE(
      std::is_sorted(seen.scan.detections.begin(), seen.scan.detections.end(),
                     [](const auto& a, const auto& b) { return a.position.x() < b.position.x(); }));
}

// Derived: what lies outside the field of view is never seen.
TEST(Sensor, SeesNothingOutsideItsFieldOfView) {
  const auto seen = observe(camera(), 0, 0, truth_at(0, {Vec2(111, 0), Vec2(5, 0)}), setting(5));
  EXPECT_EQ(seen.origins, std::vector<ObjectId>{1});
}

// Derived: binomial count of right labels; 0 means that no class is reported.
TEST(Sensor, ReportsTheRightClassWithTheStatedProbability) {
  SensorConfig sensor = camera();
  sensor.classify = 0.9;
  constexpr int kScans = 5000;
  int right = 0;
  for (int scan = 0; scan < kScans; ++scan) {
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(6));
    right += seen.scan.detections.at(0).label == "ball";
  }
  EXPECT_NEAR(right, 0.9 * kScans, 4.5 * std::sqrt(kScans * 0.9 * 0.1));
  sensor.classify = 0.0;
  const auto seen = observe(sensor, 0, 0, truth_at(0, {Vec2(50, 50)}), setting(6));
  EXPECT_EQ(seen.scan.detections.at(0).label, "");
}

// Derived: the wrong classes are the other regimes, equally often, whoever is in the scene.
TEST(Sensor, ConfusesAClassWithAnyOther) {
  SensorConfig sensor = camera();
  sensor.classify = 0.4;
  constexpr int kScans = 6000;
  std::map<std::string, int> count;
  for (int scan = 0; scan < kScans; ++scan) {
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(7));
    ++count[seen.scan.detections.at(0).label];
  }
  EXPECT_NEAR(count["train"], 0.3 * kScans, 4.5 * std::sqrt(kScans * 0.3 * 0.7));
  EXPECT_NEAR(count["balloon"], 0.3 * kScans, 4.5 * std::sqrt(kScans * 0.3 * 0.7));
}

/// In how many of `scans` scans an object at (50, 50) is detected.
int times_detected(const SensorConfig& sensor, int scans, std::uint64_t seed) {
  int detected = 0;
  for (int scan = 0; scan < scans; ++scan) {
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(seed));
    detected += detection_of(seen, 0) != nullptr;
  }
  return detected;
}

// Derived: half as often at half_range, a 16th of the exponent at half of it; binomial count.
TEST(Sensor, DetectsLessOftenFarFromItsSite) {
  SensorConfig sensor = camera();
  sensor.site = Vec2(20, 10);  // 50 m away
  sensor.detection_probability = 0.9;
  constexpr int kScans = 8000;
  for (const auto& [half_range, expected] :
       {std::pair(50.0, 0.45), std::pair(100.0, 0.9 * std::exp2(-1.0 / 16.0))}) {
    sensor.half_range = half_range;
    EXPECT_NEAR(times_detected(sensor, kScans, 8), expected * kScans,
                4.5 * std::sqrt(kScans * expected * (1.0 - expected)));
  }
}

// Derived: half as often at half_size; at twice the size 1 / (1 + 2^−4.1); binomial count.
TEST(Sensor, DetectsSmallObjectsLessOften) {
  SensorConfig sensor = camera();
  std::vector<ObjectInfo> objects = kObjects;
  objects[0].outline = {.shape = Outline::Shape::kBox, .length = 4.0, .width = 1.0};  // size 2
  constexpr int kScans = 8000;
  for (const auto& [half_size, expected] :
       {std::pair(2.0, 0.5), std::pair(1.0, 1.0 / (1.0 + std::exp2(-4.1)))}) {
    sensor.half_size = half_size;
    int detected = 0;
    for (int scan = 0; scan < kScans; ++scan) {
      const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(9, objects));
      detected += !seen.origins.empty();
    }
    EXPECT_NEAR(detected, expected * kScans, 4.5 * std::sqrt(kScans * expected * (1.0 - expected)));
  }
}

/// How often the error along x exceeds a limit, among `scans` scans.
int times_beyond(const SensorConfig& sensor, double limit, int scans) {
  int beyond = 0;
  for (int scan = 0; scan < scans; ++scan) {
    const auto seen = observe(sensor, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(10));
    beyond += std::abs(seen.scan.detections.at(0).position.x() - 50.0) > limit;
  }
  return beyond;
}

// Derived: P(|t| > x) is 1 − 2 arctan(x)/π for 1 degree of freedom, and 1 − x/√(2 + x²) for 2; the
// scale is the stated sigma.
TEST(Sensor, HasTheTailsOfStudentsT) {
  SensorConfig sensor = camera();
  std::get<PositionSensor>(sensor.model).noise = 0.5;
  constexpr int kScans = 10000;
  const auto expect_share = [&](double limit, double share) {
    EXPECT_NEAR(times_beyond(sensor, 0.5 * limit, kScans), share * kScans,
                4.5 * std::sqrt(kScans * share * (1.0 - share)));
  };
  sensor.student_dof = 1.0;
  expect_share(1.0, 0.5);
  expect_share(10.0, 1.0 - 2.0 * std::atan(10.0) / 3.141592653589793);
  sensor.student_dof = 2.0;
  expect_share(2.0, 1.0 - 2.0 / std::sqrt(6.0));
}

// Property: with many degrees of freedom the errors are the Gaussian ones, draw for draw.
TEST(Sensor, StretchesTheGaussianErrorsIntoHeavyTails) {
  const SensorConfig gaussian = camera();
  SensorConfig student = camera();
  student.student_dof = 1e6;
  for (int scan = 0; scan < 50; ++scan) {
    const auto a = observe(gaussian, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(11));
    const auto b = observe(student, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(11));
    EXPECT_NEAR((a.scan.detections[0].position - b.scan.detections[0].position).norm(), 0.0, 1e-4);
  }
}

// Derived: with probability p an error is s times its Gaussian self, otherwise itself.
TEST(Sensor, MakesOutliersOfSomeErrors) {
  const SensorConfig gaussian = camera();
  SensorConfig wild = camera();
  wild.outlier_probability = 0.1;
  wild.outlier_scale = 20.0;
  constexpr int kScans = 5000;
  int outliers = 0;
  for (int scan = 0; scan < kScans; ++scan) {
    const auto a = observe(gaussian, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(12));
    const auto b = observe(wild, 0, scan, truth_at(0, {Vec2(50, 50)}), setting(12));
    const Vec2 error = a.scan.detections[0].position - Vec2(50, 50);
    const Vec2 wild_error = b.scan.detections[0].position - Vec2(50, 50);
    const bool outlier = wild_error != error;
    outliers += outlier;
    if (!outlier) continue;
    EXPECT_NEAR((wild_error - 20.0 * error).norm(), 0.0, 1e-9);
  }
  EXPECT_NEAR(outliers, 0.1 * kScans, 4.5 * std::sqrt(kScans * 0.1 * 0.9));
}

// Derived: two objects closer than the resolution are one detection at their mean, of the first.
TEST(Sensor, MergesWhatItCannotResolve) {
  SensorConfig sensor = camera();
  std::get<PositionSensor>(sensor.model).noise = 1e-6;
  sensor.resolution = 2.0;
  const auto seen = observe(sensor, 0, 0, truth_at(0, {Vec2(50, 50), Vec2(51, 50)}), setting(13));
  ASSERT_EQ(seen.origins.size(), 1U);
  EXPECT_NEAR(seen.scan.detections[0].position.x(), 50.5, 1e-4);
  EXPECT_GE(seen.origins[0], 0);
}

// Derived: an object behind a nearer one of its size is hidden; the one in front is not.
TEST(Sensor, DoesNotSeeWhatIsHidden) {
  SensorConfig sensor = camera();
  std::vector<ObjectInfo> objects = kObjects;
  for (ObjectInfo& object : objects) object.outline.length = 1.0;
  TruthSnapshot truth = truth_at(0, {Vec2(50, 50), Vec2(50.1, 50)});
  truth.bodies = {{0, Vec2(50, 50), 0.0}, {1, Vec2(50.1, 50), 0.0}};
  EXPECT_EQ(observe(sensor, 0, 0, truth, setting(14, objects)).origins.size(), 2U);
  sensor.occlusion = 0.5;
  EXPECT_EQ(observe(sensor, 0, 0, truth, setting(14, objects)).origins, std::vector<ObjectId>{1});
  sensor.nearest_first = {"a"};
  EXPECT_EQ(observe(sensor, 0, 0, truth, setting(14, objects)).origins, std::vector<ObjectId>{0});
}

// Property: every kind of sensor puts its clutter into its view and knows the errors of what it
// reports; a radar's detections differ in their covariance.
TEST(Sensor, OfEveryKindReportsUsableDetectionsInItsView) {
  for (SensorConfig sensor : {radar(), image_camera()}) {
    sensor.clutter = 20.0;
    const auto seen = observe(sensor, 0, 0, truth_at(0, {Vec2(50, 50)}), setting(15));
    EXPECT_GT(seen.origins.size(), 5U);
    for (const Detection& detection : seen.scan.detections) {
      EXPECT_TRUE(contains(sensor.view(), detection.position));
      EXPECT_GT(detection.covariance.determinant(), 0.0);
    }
    EXPECT_GT(traits_of(sensor).sigma, 0.0);
  }
}

// Property: whatever a scene may say, detections are finite with a positive definite covariance.
TEST(Sensor, ReportsFiniteDetectionsForExtremeSettings) {
  Pinhole steep{.position = Vec2(0, 0), .distance = 5.0, .focal_px = 2000.0, .pan_deg = 60.0};
  Camera tilted;
  tilted.lens = steep;
  tilted.noise_px = 50.0;
  tilted.quantum_px = 700.0;
  Radar coarse;
  coarse.sigma_range = 1e5;
  coarse.sigma_bearing_deg = 45.0;
  coarse.max_range = 1e6;
  Radar fine;
  fine.sigma_range = 1e-6;
  fine.sigma_bearing_deg = 1e-3;
  for (const SensorModel& model : {SensorModel(tilted), SensorModel(coarse), SensorModel(fine)}) {
    SensorConfig sensor;
    sensor.name = "extreme";
    sensor.model = model;
    sensor.student_dof = 1.0;
    sensor.outlier_probability = 0.5;
    sensor.outlier_scale = 1e4;
    sensor.clutter = 5.0;
    for (int scan = 0; scan < 300; ++scan) {
      const Vec2 place = point_in(sensor.view(), 0.3, 0.6);
      const auto seen = observe(sensor, 0, scan, truth_at(0, {place}), setting(16));
      for (const Detection& detection : seen.scan.detections) {
        ASSERT_TRUE(detection.position.allFinite());
        ASSERT_TRUE(detection.covariance.allFinite());
        ASSERT_GT(detection.covariance(0, 0), 0.0);
        ASSERT_GT(detection.covariance.determinant(), 0.0);
      }
    }
  }
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

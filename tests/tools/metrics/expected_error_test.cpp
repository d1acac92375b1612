#include "tools/metrics/expected_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

constexpr double kPeriod = 0.5;
constexpr double kSigma = 0.3;

SensorConfig camera() {
  SensorConfig sensor;
  sensor.name = "camera";
  sensor.rate = 1.0 / kPeriod;
  PositionSensor position;
  position.noise = kSigma;
  sensor.model = position;
  return sensor;
}

/// At the time t under the acceleration (0, a).
TruthState accelerating(double t, double a) {
  TruthState truth;
  truth.position = {t, 0.5 * a * t * t};
  truth.velocity = {1.0, a * t};
  truth.acceleration = {0.0, a};
  return truth;
}

/// What is expected of a filter after so many scans, with a detection in each.
ExpectedError::Value after(const Filter& fresh, int scans, double acceleration,
                           const SensorConfig& sensor = camera()) {
  const auto errors = error_parts(sensor).value();
  std::optional<ExpectedError> error;
  for (int i = 0; i < scans; ++i) {
    const TruthState truth = accelerating(kPeriod * i, acceleration);
    const Detection detection = noiseless_detection(sensor, truth.position).value();
    const SensedDetection used{sensor, errors, detection};
    if (error) {
      error->advance(truth, kPeriod * i, used);
    } else {
      error.emplace(fresh, truth, used, 0.0, 1, ExpectedError::Noise::kNormal);
    }
  }
  return error->value(accelerating(kPeriod * (scans - 1), acceleration));
}

Filter gh(double g, double h) {
  return make_filter(GhConfig{.design = gain_design::Manual<1>{g, h, 0.0}}, kSigma, kPeriod);
}

// Derived: after a long time the variance reduction factors, and the lags under a lasting
// acceleration: position (1 − g) a T² / h = 1.25 m, velocity a T (2g − h) / 2h = 2 m/s, prediction
// a T² / h = 2.5 m.
TEST(ExpectedError, TendsToTheSteadyState) {
  const ExpectedError::Value value = after(gh(0.5, 0.2), 400, 2.0);
  const VarianceReduction noise = variance_reduction(Gains::of_gh(0.5, 0.2), kPeriod);
  const double variance = kSigma * kSigma;
  EXPECT_NEAR(value.position_variance, 2.0 * noise.x * variance, 1e-9);
  EXPECT_NEAR(value.velocity_variance, 2.0 * noise.dx * variance, 1e-9);
  EXPECT_NEAR(value.position.y(), -1.25, 1e-9);
  EXPECT_NEAR(value.velocity.y(), -2.0, 1e-9);
  ASSERT_TRUE(value.innovation);
  EXPECT_NEAR(value.innovation->mean.y(), 2.5, 1e-9);
  EXPECT_NEAR(value.innovation->covariance(0, 0), variance * (1.0 + noise.prediction), 1e-9);
}

// Derived: with errors that have a direction of their own, a g-h filter lets through as much of
// them as of any others, after any time: K H is a number, so P tends to VRF_x R.
TEST(ExpectedError, StaysWhatItIsForARadar) {
  SensorConfig sensor = camera();
  Radar radar;
  radar.sigma_range = 1.0;
  radar.sigma_bearing_deg = 0.3;
  sensor.model = radar;
  const auto errors = error_parts(sensor).value();
  TruthState truth;
  truth.position = {200.0, 200.0};
  std::optional<ExpectedError> error;
  for (int i = 0; i < 2000; ++i) {
    const double turn = 1e-4 * ((i * 7) % 5 - 2);  // detections tell slightly other covariances
    Detection detection = radar.measure(truth.position, sensor.site, {0.0, turn}).value();
    const SensedDetection used{sensor, errors, detection};
    if (error) {
      error->advance(truth, kPeriod * i, used);
    } else {
      error.emplace(gh(0.5, 0.2), truth, used, 0.0, 1, ExpectedError::Noise::kNormal);
    }
  }
  const ExpectedError::Value value = error->value(truth);
  const Eigen::Matrix2d r = noiseless_detection(sensor, truth.position).value().covariance;
  const VarianceReduction noise = variance_reduction(Gains::of_gh(0.5, 0.2), kPeriod);
  EXPECT_NEAR(value.position_variance, noise.x * r.trace(), 1e-3 * r.trace());
  ASSERT_TRUE(value.innovation);
  EXPECT_NEAR(value.innovation->covariance(0, 1), (1.0 + noise.prediction) * r(0, 1),
              1e-3 * r.trace());
}

// Derived: constant gains let through the noise of each axis by itself, so that an ellipse that
// turns from scan to scan leaves a covariance of the same trace; what rounding makes of its
// symmetry fades.
TEST(ExpectedError, StaysExactWhereNoiseIsElongated) {
  const SensorConfig sensor = camera();
  const auto errors = error_parts(sensor).value();
  std::optional<ExpectedError> error;
  TruthState truth;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 0.7 * i;
    const Vec2 along(std::cos(angle), std::sin(angle));
    Detection detection = noiseless_detection(sensor, truth.position).value();
    detection.covariance = 0.01 * Eigen::Matrix2d::Identity() + 0.08 * along * along.transpose();
    const SensedDetection used{sensor, errors, detection};
    if (error) {
      error->advance(truth, kPeriod * i, used);
    } else {
      error.emplace(gh(0.5, 0.2), truth, used, 0.0, 1, ExpectedError::Noise::kNormal);
    }
  }
  const double noise = variance_reduction(Gains::of_gh(0.5, 0.2), kPeriod).x;
  EXPECT_NEAR(error->value(truth).position_variance, noise * 0.10, 1e-9);
}

// Derived: growing memory of order 1 after n measurements: variance 2 (2n − 1) / (n (n + 1)) σ² per
// axis (Zarchan & Musoff 2000), exact for constant velocity.
TEST(ExpectedError, IsExactWhileStarting) {
  const ExpectedError::Value value = after(gh(0.02, 0.0002), 10, 0.0);
  EXPECT_NEAR(value.position_variance, 2.0 * 2.0 * 19.0 / 110.0 * kSigma * kSigma, 1e-9);
  EXPECT_NEAR(value.position.norm(), 0.0, 1e-9);
}

// Derived: a bias is passed on whole; errors with variance 1 + p (s² − 1) let through as much more.
TEST(ExpectedError, CountsBiasAndOutliers) {
  SensorConfig sensor = camera();
  sensor.outlier_probability = 0.1;
  sensor.outlier_scale = 3.0;
  std::get<PositionSensor>(sensor.model).bias = {0.4, -0.1};
  const ExpectedError::Value value = after(gh(0.5, 0.2), 400, 0.0, sensor);
  const double noise = variance_reduction(Gains::of_gh(0.5, 0.2), kPeriod).x;
  EXPECT_NEAR(value.position_variance, 2.0 * noise * 1.8 * kSigma * kSigma, 1e-9);
  EXPECT_NEAR(value.position.x(), 0.4, 1e-9);
}

// Derived: Student's t has variance ν / (ν − 2), and none with two degrees of freedom or fewer.
TEST(ErrorParts, HaveTheVarianceOfTheSensor) {
  SensorConfig sensor = camera();
  sensor.student_dof = 5.0;
  double variance = 0.0, probability = 0.0;
  const std::vector<ErrorPart> parts = error_parts(sensor).value();
  for (const ErrorPart& part : parts) {
    variance += part.probability * part.variance_factor;
    probability += part.probability;
  }
  EXPECT_NEAR(probability, 1.0, 1e-12);
  EXPECT_NEAR(variance, 5.0 / 3.0, 1e-12);
  sensor.student_dof = 2.0;
  EXPECT_FALSE(error_parts(sensor));
}

// Derived: Rayleigh's mean √(π/2) without a mean, the mean alone without noise, one axis |N|
// √(2/π).
TEST(ExpectedLength, IsThatOfRayleigh) {
  const Eigen::Matrix2d unit = Eigen::Matrix2d::Identity();
  EXPECT_NEAR(expected_length(Vec2::Zero(), unit), std::sqrt(0.5 * std::numbers::pi), 2e-4);
  EXPECT_NEAR(expected_length({3.0, 4.0}, Eigen::Matrix2d::Zero()), 5.0, 1e-3);
  Eigen::Matrix2d line = Eigen::Matrix2d::Zero();
  line(1, 1) = 4.0;
  EXPECT_NEAR(expected_length(Vec2::Zero(), line), 2.0 * std::sqrt(2.0 / std::numbers::pi), 1e-3);
}

// Derived: far from the edge of a cell all detections say its middle, without noise; on the edge
// half of them say the middle of either cell.
TEST(ExpectedMeasurement, KnowsWhatRoundingMakesOfAPlace) {
  Camera camera_model;
  camera_model.noise_px = 0.1;
  camera_model.quantum_px = 4.0;
  camera_model.lens = FlatLens{.metres_per_pixel = 0.5};
  SensorConfig sensor = camera();
  sensor.model = camera_model;
  const auto errors = error_parts(sensor).value();
  const auto seen = [&](const Vec2& place) {
    const Detection told = camera_model.measure(place, Vec2::Zero(), Vec2::Zero()).value();
    return expected_measurement(sensor, errors, place, told).value();
  };
  // The middle of the image, at the pixels (960, 540), is the corner of four cells 2 m wide.
  const ExpectedMeasurement inside = seen({0.6, 1.3});
  EXPECT_LT((inside.mean.position - Vec2(1.0, 1.0)).norm(), 1e-9);
  EXPECT_LT(inside.covariance.norm(), 1e-9);
  const ExpectedMeasurement edge = seen({2.0, 0.6});
  EXPECT_LT((edge.mean.position - Vec2(2.0, 1.0)).norm(), 1e-9);
  EXPECT_NEAR(edge.covariance(0, 0), 1.0, 1e-9);
  EXPECT_NEAR(edge.covariance(1, 1), 0.0, 1e-9);
}

// Property: with noise beyond a cell rounding is noise of its own, of variance cell²/12.
TEST(ExpectedMeasurement, TakesRoundingForNoiseBesideMuchNoise) {
  Camera camera_model;
  camera_model.noise_px = 1.5;
  camera_model.quantum_px = 1.0;
  camera_model.lens = Pinhole{.distance = 40.0, .pan_deg = 20.0};
  SensorConfig sensor = camera();
  sensor.model = camera_model;
  const auto errors = error_parts(sensor).value();
  for (const Vec2& place : {Vec2(0.0, 0.0), Vec2(3.21, -4.7), Vec2(-6.5, 2.9)}) {
    const Detection told = camera_model.measure(place, Vec2::Zero(), Vec2::Zero()).value();
    const ExpectedMeasurement seen = expected_measurement(sensor, errors, place, told).value();
    EXPECT_LT((seen.mean.position - place).norm(), 1e-3 * std::sqrt(told.covariance.trace()));
    EXPECT_LT((seen.covariance - told.covariance).norm(), 0.02 * told.covariance.norm());
  }
}

}  // namespace
}  // namespace ghtrack

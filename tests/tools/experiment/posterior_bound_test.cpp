#include "tools/experiment/posterior_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/schema/reader.hpp"
#include "sim/random.hpp"
#include "tests/tools/experiment/sample_campaign.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

using Matrix = MotionLaw::Matrix;

/// An acceleration that is new at every second, and constant in between: Kalata's model.
MotionLaw jerky(double sigma) {
  MotionLaw law = drifting();
  law.noise = [sigma](double dt) {
    Matrix q = Matrix::Zero(4, 4);
    for (int axis = 0; axis < 2; ++axis) {
      q(axis, axis) = 0.25 * dt * dt * dt * dt;
      q(axis, 2 + axis) = q(2 + axis, axis) = 0.5 * dt * dt * dt;
      q(2 + axis, 2 + axis) = dt * dt;
    }
    return Matrix(sigma * sigma * q);
  };
  return law;
}

/// Seen once a second.
LabelledObject seen(int scans) {
  LabelledObject object;
  for (int i = 0; i < scans; ++i) {
    TruthState truth;
    truth.position = {3.0 * i, 0.0};
    object.scans.push_back({static_cast<double>(i), truth, Detection{}, 0});
  }
  return object;
}

SensorConfig sensor_with(double sigma) {
  SensorConfig sensor;
  sensor.rate = 1.0;
  PositionSensor position;
  position.noise = sigma;
  sensor.model = position;
  return sensor;
}

std::optional<double> bound_of(const LabelledObject& object, const SensorConfig& sensor,
                               const MotionLaw& law) {
  const std::vector<std::optional<RandomMotion>> motions = {RandomMotion{law, 0.0}};
  return posterior_bound({&object}, std::vector{sensor}, motions);
}

// Derived: for Kalata's model the bound tends to the error of the steady Kalman filter, σ √g per
// axis.
TEST(PosteriorBound, TendsToTheSteadyKalmanFilter) {
  for (const double index : {0.05, 0.5, 5.0}) {
    const double sigma = 2.0;
    const double steady = sigma * std::sqrt(2.0 * tracking_index_gains(1, index).g);
    const LabelledObject object = seen(20'000);
    EXPECT_NEAR(*bound_of(object, sensor_with(sigma), jerky(index * sigma)), steady, 1e-3 * steady);
  }
}

// Derived: a start x = v t from a known place with v ~ N(0, s²) has, after detections at the times
// t_i, the variance 1 / (1/s² + Σ t_i² / σ²) of v on each axis; the third scan is the first that
// counts.
TEST(PosteriorBound, OfARandomStartIsThatOfItsVelocity) {
  MotionLaw law = drifting();
  law.start(2, 2) = law.start(3, 3) = 4.0;
  const LabelledObject object = seen(4);
  const double at_two = 4.0 / (1.0 / 4.0 + (1.0 + 4.0) / 9.0);
  const double at_three = 9.0 / (1.0 / 4.0 + (1.0 + 4.0 + 9.0) / 9.0);
  EXPECT_NEAR(*bound_of(object, sensor_with(3.0), law), std::sqrt(at_two + at_three), 1e-12);
}

// Derived: of a radar, r² σ_θ² across the line of sight and σ_r² along it, here with a start that
// is as good as unknown, and no motion.
TEST(PosteriorBound, OfARadarIsThatOfItsRangeAndBearing) {
  LabelledObject object = seen(3);
  for (ObjectScan& scan : object.scans) scan.truth.position = {300.0, 400.0};
  SensorConfig sensor = sensor_with(1.0);
  Radar radar;
  radar.sigma_range = 2.0;
  radar.sigma_bearing_deg = 0.5;
  sensor.model = radar;
  MotionLaw law = drifting();
  law.start(0, 0) = law.start(1, 1) = 1e10;
  const double across = 500.0 * 0.5 * M_PI / 180.0;
  EXPECT_NEAR(*bound_of(object, sensor, law), std::sqrt((4.0 + across * across) / 3.0), 1e-3);
}

// Derived: white noise in the acceleration, Q = q [T³/3 T²/2; T²/2 T], and an acceleration that
// fades with the time τ, whose variance tends to q τ / 2 (Singer 1970).
TEST(MotionLaw, SolvesStochasticEquations) {
  Matrix a = Matrix::Zero(2, 2), w = Matrix::Zero(2, 2);
  a(0, 1) = 1.0;
  w(1, 1) = 3.0;
  const Matrix q = driven(a, w).noise(0.7);
  EXPECT_NEAR(q(0, 0), 3.0 * 0.7 * 0.7 * 0.7 / 3.0, 1e-14);
  EXPECT_NEAR(q(0, 1), 3.0 * 0.7 * 0.7 / 2.0, 1e-14);
  EXPECT_NEAR(q(1, 1), 3.0 * 0.7, 1e-14);
  Matrix fading = Matrix::Zero(1, 1), white = Matrix::Zero(1, 1);
  fading(0, 0) = -1.0 / 5.0;
  white(0, 0) = 3.0;
  const MotionLaw law = driven(fading, white);
  EXPECT_NEAR(law.transition(2.0)(0, 0), std::exp(-0.4), 1e-14);
  EXPECT_NEAR(law.noise(200.0)(0, 0), 3.0 * 5.0 / 2.0, 1e-10);
}

bool has_bound(const std::string& target, const std::string& compare, Runs runs,
               const std::string& world = "{air: {density: 0}}") {
  const std::string text = "name: b\nduration: 5\nworld: " + world + "\ntargets: [" + target +
                           "]\nsensors: [{name: cam, rate: 10, noise: 1}]\ncompare: " + compare +
                           "\n";
  const auto scene = std::get<WorldScene>(read_scene_text(text, "b.yaml"));
  return random_motions(scene, runs).front().has_value();
}

// Derived: a motion has a bound if it is random, and by a law that is exact.
TEST(RandomMotions, AreThoseWhoseLawIsKnown) {
  const std::string ball = "{name: a, ball: {position: [0, 0], velocity: [3, 4]}}";
  const std::string other = ", {name: b, ball: {position: [9, 0], velocity: [3, 4]}}";
  const std::string scattered = "{runs: 5, launch: {velocity: 1}}";
  EXPECT_TRUE(has_bound(ball, scattered, Runs::kMany));
  EXPECT_FALSE(has_bound(ball, scattered, Runs::kOne)) << "the scene's own start";
  EXPECT_FALSE(has_bound(ball, "{runs: 5}", Runs::kMany)) << "nothing differs";
  EXPECT_FALSE(has_bound(ball + other, scattered, Runs::kMany)) << "they may meet";
  EXPECT_FALSE(has_bound(ball, scattered, Runs::kMany, "{}")) << "drag is not linear";
  EXPECT_FALSE(
      has_bound(ball, scattered, Runs::kMany, "{air: {density: 0}, ground: {height: -9}}"));
  const std::string route = "{name: a, route: {position: [0, 0], speed: 9, process_noise: {";
  EXPECT_TRUE(
      has_bound(route + "model: singer, sigma: 1}}}", "{runs: 5, fresh_wind: true}", Runs::kMany));
  EXPECT_TRUE(has_bound(route + "model: constant-velocity, spectral_density: 1}}}", "{runs: 5}",
                        Runs::kOne));
  EXPECT_FALSE(has_bound(route + "model: constant-velocity, spectral_density: 1}}}", "{runs: 5}",
                         Runs::kMany))
      << "all runs have the same draw";
  EXPECT_FALSE(
      has_bound(route + "model: coordinated-turn, turn_rate_deg: 1}}}", "{runs: 5}", Runs::kOne));
  EXPECT_FALSE(has_bound("{name: a, train: {stock: ideal, speed: 20}}", "{runs: 5}", Runs::kMany));
  EXPECT_FALSE(has_bound("{name: a, balloon: {position: [0, 9]}}", "{runs: 5, fresh_wind: true}",
                         Runs::kMany, "{wind: {turbulence: {model: ornstein-uhlenbeck}}}"));
}

}  // namespace
}  // namespace ghtrack

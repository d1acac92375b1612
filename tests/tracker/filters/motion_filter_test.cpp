#include "tracker/filters/motion_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

#include "tracker/filters/filter.hpp"

namespace ghtrack {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kStep = 0.5;

MotionFilter<2> make(const TargetMotion& motion, Propagation propagation, double sigma = 1.0) {
  return MotionFilter<2>({.motion = motion,
                          .propagation = propagation,
                          .sigma = sigma,
                          .interval = kStep,
                          .initial_speed = 30.0});
}

// Derived: where everything is linear, all three are the Kalman filter.
TEST(MotionFilter, IsTheKalmanFilterWhereAllIsLinear) {
  const PolynomialMotion motion{.order = 2, .process_intensity = 0.3, .initial_acceleration = 4.0};
  KalmanFilter<2, 2> kalman({.process_model = ProcessModel::kWhiteNoise,
                             .process_intensity = 0.3,
                             .initial_speed = 30.0,
                             .initial_acceleration = 4.0});
  MotionFilter<2> extended = make(motion, Propagation::kExtended);
  MotionFilter<2> unscented = make(motion, Propagation::kUnscented);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Matrix2d r;
  r << 1.0, 0.3, 0.3, 2.0;
  for (int i = 0; i < 100; ++i) {
    const double dt = i % 3 == 0 ? 0.1 : kStep;
    const Vector2d z(2.0 * i + normal(random), 0.1 * i * i + normal(random));
    kalman.predict(dt);
    kalman.update(z, r);
    for (MotionFilter<2>* filter : {&extended, &unscented}) {
      filter->predict(dt);
      filter->update(z, r);
      EXPECT_LT((filter->estimate().position - kalman.estimate().position).norm(), 1e-9);
      EXPECT_LT((filter->estimate().acceleration - kalman.estimate().acceleration).norm(), 1e-8);
      EXPECT_LT((filter->position_sigma() - kalman.position_sigma()).norm(), 1e-9);
      if (i > 0) {
        EXPECT_NEAR(filter->log_likelihood(), kalman.log_likelihood(), 1e-8);
      }
    }
  }
}

// Derived: a circle of speed v and rate ω has the radius v / ω and closes after 2π / ω.
TEST(CoordinatedTurn, GoesRoundACircle) {
  const CoordinatedTurn turn;
  MotionState x(5);
  x << 7.0, 2.0, 10.0, 0.0, 0.25;
  const double round = 2.0 * std::numbers::pi / 0.25;
  EXPECT_LT((turn.moved(x, round) - x).norm(), 1e-12);
  const MotionState opposite = turn.moved(x, 0.5 * round);
  EXPECT_NEAR(opposite[0], 7.0, 1e-12);
  EXPECT_NEAR(opposite[1], 2.0 + 2.0 * 10.0 / 0.25, 1e-12);
  x[4] = 0.0;
  EXPECT_NEAR(turn.moved(x, 3.0)[0], 37.0, 1e-12);
}

// Derived: vertical fall with quadratic drag: v = −v_t tanh(g t / v_t), v_t = √(g / c).
TEST(Ballistic, FallsTowardsItsTerminalSpeed) {
  const Ballistic flight;
  const double c = 0.02;
  const double terminal = std::sqrt(flight.gravity / c);
  MotionState x(5);
  x << 0.0, 100.0, 0.0, 0.0, c;
  const double t = 3.0;
  const MotionState fallen = flight.moved(x, t);
  EXPECT_NEAR(fallen[3], -terminal * std::tanh(flight.gravity * t / terminal), 1e-6);
  EXPECT_NEAR(fallen[1], 100.0 - std::log(std::cosh(flight.gravity * t / terminal)) / c, 1e-6);
}

/// Mean squared errors of position over tracks of a motion with the filter's own noise.
struct Outcome {
  double squares = 0.0;  // of position errors [m²]
  double nees = 0.0;     // of position, 2 where the covariance is right
};

/// Follows a target on a circle with a radar of range and bearing.
Outcome circle_under_radar(Filter filter, bool polar, std::uint64_t seed) {
  constexpr double kRange = 2.0, kBearing = 0.02, kRate = 0.2, kSpeed = 25.0;
  const Vector2d site(0.0, 0.0), centre(-300.0, 0.0);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Outcome mean;
  constexpr int kTracks = 60, kSteps = 120;
  int count = 0;
  for (int track = 0; track < kTracks; ++track) {
    Filter f = filter;
    for (int i = 0; i < kSteps; ++i) {
      const double angle = kRate * kStep * i;
      const Vector2d truth = centre + kSpeed / kRate * Vector2d(std::cos(angle), std::sin(angle));
      const Vector2d offset = truth - site;
      const double range = offset.norm() + kRange * normal(random);
      const double bearing = std::atan2(offset.y(), offset.x()) + kBearing * normal(random);
      const Vector2d u(std::cos(bearing), std::sin(bearing)), v(-u.y(), u.x());
      Detection detection;
      detection.position = site + range * u;
      detection.covariance =
          kRange * kRange * u * u.transpose() + std::pow(range * kBearing, 2) * v * v.transpose();
      const double wrapped = std::remainder(bearing, 2.0 * std::numbers::pi);
      if (polar) {
        detection.measured =
            Measurement{Vector2d(range, wrapped),
                        Matrix2d(Vector2d(kRange * kRange, kBearing * kBearing).asDiagonal()),
                        RangeBearingModel{site}};
      }
      if (i > 0) predict(f, kStep);
      update(f, detection);
      if (i < 40) continue;
      const Vector2d error = estimate(f).position - truth;
      const Matrix2d p = position_covariance(f);
      mean.squares += error.squaredNorm();
      mean.nees += error.dot(p.inverse() * error);
      ++count;
    }
  }
  mean.squares /= count;
  mean.nees /= count;
  return mean;
}

// Property: who turns as assumed is followed better than by one that assumes straight paths, across
// the jump of the bearing at 180 degrees, too; and the predicted error is that made.
TEST(MotionFilter, FollowsATurnUnderARadar) {
  const CoordinatedTurn turning{.spectral_density = 0.05, .turn_density = 1e-5};
  const double straight =
      circle_under_radar(
          make_filter(KalmanCvConfig{.model = process::WhiteNoise<1>{.spectral_density = 10.0}},
                      5.0, kStep),
          false, 3)
          .squares;
  for (const FilterConfig& config :
       {FilterConfig(EkfConfig{.motion = turning}), FilterConfig(UkfConfig{.motion = turning})}) {
    const Outcome outcome = circle_under_radar(make_filter(config, 5.0, kStep), true, 3);
    EXPECT_LT(outcome.squares, 0.5 * straight);
    EXPECT_LT(outcome.nees, 2.6);
    EXPECT_GT(outcome.nees, 1.0);
  }
}

// Derived: by central differences.
TEST(MeasurementModel, HasTheDerivativeOfItsFunction) {
  Eigen::Matrix3d h;
  h << 900.0, 20.0, 300.0, -30.0, -880.0, 200.0, 0.01, -0.02, 40.0;
  const Vector2d position(13.0, -7.0), velocity(3.0, 4.0);
  for (const MeasurementModel& model :
       {MeasurementModel(PositionModel{}), MeasurementModel(RangeBearingModel{{2.0, 1.0}}),
        MeasurementModel(RangeBearingRateModel{{2.0, 1.0}}), MeasurementModel(PixelModel{h})}) {
    const PredictedMeasurement at = predicted(model, position, velocity);
    constexpr double kSmall = 1e-5;
    for (int i = 0; i < 4; ++i) {
      Eigen::Vector4d step = kSmall * Eigen::Vector4d::Unit(i);
      const MeasuredVector above =
          predicted(model, position + step.head<2>(), velocity + step.tail<2>()).z;
      const MeasuredVector below =
          predicted(model, position - step.head<2>(), velocity - step.tail<2>()).z;
      const MeasuredVector slope = (above - below) / (2.0 * kSmall);
      EXPECT_LT((at.jacobian.col(i) - slope).norm(), 1e-6 * (1.0 + slope.norm()));
    }
  }
}

}  // namespace
}  // namespace ghtrack

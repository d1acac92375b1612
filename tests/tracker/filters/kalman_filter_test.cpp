#include "tracker/filters/kalman_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

#include "tracker/filters/gain_filter.hpp"

namespace ghtrack {
namespace {

using Scalar = Eigen::Matrix<double, 1, 1>;

/// The position gain P' / S of a filter after many updates.
template <int Order>
double converged_position_gain(const KalmanModel& model) {
  KalmanFilter<Order, 1> filter(model);
  for (int step = 0; step < 3000; ++step) {
    filter.predict(model.interval);
    filter.update(Scalar(0.0));
  }
  filter.predict(model.interval);
  const double s = filter.innovation_covariance()(0, 0);
  return (s - model.sigma * model.sigma) / s;
}

// Derived: Kalata's closed forms.
TEST(KalmanFilter, ConvergesToTheTrackingIndexGains) {
  for (const double index : {0.01, 0.3, 2.0, 50.0}) {
    KalmanModel model{
        .sigma = 2.0, .interval = 0.5, .initial_speed = 30.0, .initial_acceleration = 20.0};
    for (const ProcessModel process :
         {ProcessModel::kPiecewiseConstant, ProcessModel::kRandomWalk, ProcessModel::kWhiteNoise}) {
      model.process_model = process;
      model.process_intensity = intensity_of_index(process, index, 2.0, 0.5);
      const KalmanFilter<1, 1> filter(model);
      const Gains expected = tracking_index_gains(1, index, process);
      EXPECT_NEAR(converged_position_gain<1>(model), expected.g, 1e-12);
      EXPECT_NEAR(filter.steady_gains().h, expected.h, 1e-12);
      if (process == ProcessModel::kWhiteNoise) continue;
      EXPECT_NEAR(converged_position_gain<2>(model), tracking_index_gains(2, index).g, 1e-12);
    }
  }
}

// Derived: without process noise and with a diffuse prior it is growing memory.
TEST(KalmanFilter, WithoutProcessNoiseIsGrowingMemory) {
  KalmanFilter<1, 1> filter({.process_intensity = 0.0, .initial_speed = 1e6});
  for (int n = 1; n <= 30; ++n) {
    filter.predict(1.0);
    filter.update(Scalar(0.0));
    if (n < 2) continue;
    EXPECT_NEAR(filter.covariance()(0, 0), growing_memory_gains(1, n).g, 1e-9) << n;
  }
}

// Derived: ln N(r; 0, S) = −½ (rᵀ S⁻¹ r + ln |2π S|), with a correlated measurement error.
TEST(KalmanFilter, ReportsLikelihoodAndNormalisedInnovation) {
  KalmanFilter<1, 2> filter({.process_intensity = 0.5, .initial_speed = 4.0});
  filter.start(Eigen::Vector2d(1.0, 2.0), Eigen::Matrix2d::Identity());
  filter.predict(0.5);
  Eigen::Matrix2d r;
  r << 2.0, 0.7, 0.7, 1.0;
  const Eigen::Matrix2d s = filter.innovation_covariance(r);
  filter.update(Eigen::Vector2d(2.0, 0.0), r);
  const Eigen::Vector2d residual(1.0, -2.0);
  const double nis = residual.dot(s.inverse() * residual);
  EXPECT_NEAR(filter.nis(), nis, 1e-12);
  EXPECT_NEAR(filter.log_likelihood(),
              -0.5 * (nis + std::log(s.determinant())) - std::log(2.0 * std::numbers::pi), 1e-12);
}

// Derived: turning the world turns the estimate; correlated errors turn with it.
TEST(KalmanFilter, DoesNotDependOnTheDirectionOfTheAxes) {
  const Eigen::Matrix2d turn{{0.6, -0.8}, {0.8, 0.6}};
  const Eigen::Matrix2d r{{4.0, 0.0}, {0.0, 0.25}};
  const KalmanModel model{
      .process_intensity = 0.7, .initial_speed = 5.0, .initial_acceleration = 5.0};
  KalmanFilter<2, 2> straight(model);
  KalmanFilter<2, 2> turned(model);
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  for (int step = 0; step < 50; ++step) {
    const double x = normal(engine);
    const Eigen::Vector2d z(3.0 * step + x, normal(engine));
    straight.predict(0.3);
    turned.predict(0.3);
    straight.update(z, r);
    turned.update(turn * z, turn * r * turn.transpose());
  }
  EXPECT_LT((turn * straight.estimate().position - turned.estimate().position).norm(), 1e-9);
  EXPECT_LT((turn * straight.estimate().velocity - turned.estimate().velocity).norm(), 1e-9);
  EXPECT_NEAR(straight.nis(), turned.nis(), 1e-9);
}

// Derived: under its own model the mean NIS is the number of axes; its standard error is √(2 D /
// n).
TEST(KalmanFilter, IsConsistentUnderItsOwnModel) {
  constexpr int kSteps = 40000;
  const double dt = 0.4;
  KalmanFilter<1, 2> filter({.sigma = 1.5, .process_intensity = 2.0, .initial_speed = 100.0});
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  Kinematics<2> truth;
  double sum = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    for (double& a : truth.acceleration) a = 2.0 * normal(engine);
    truth = extrapolated(truth, dt);
    Eigen::Vector2d z = truth.position;
    for (double& component : z) component += 1.5 * normal(engine);
    filter.predict(dt);
    filter.update(z);
    if (step >= 100) sum += filter.nis();
  }
  const double n = kSteps - 100;
  EXPECT_NEAR(sum / n, 2.0, 5.0 * std::sqrt(4.0 / n));
}

// Property: the Joseph form stays symmetric and positive over scales of 1e12.
TEST(KalmanFilter, KeepsItsCovarianceSymmetricAndPositive) {
  KalmanFilter<2, 2> filter({.sigma = 1e-6,
                             .process_intensity = 1e-3,
                             .initial_speed = 1e6,
                             .initial_acceleration = 1e6});
  for (int step = 0; step < 200; ++step) {
    filter.predict(step % 7 == 0 ? 10.0 : 0.01);
    filter.update(Eigen::Vector2d(step, -step));
    EXPECT_EQ(filter.covariance(), filter.covariance().transpose().eval());
    EXPECT_GT(filter.covariance().diagonal().minCoeff(), 0.0);
  }
}

// Derived: beyond c sigmas a residual pulls as hard as at c sigmas, and teaches c / d as much.
TEST(KalmanFilter, ShortensThePullOfAnOutlier) {
  const KalmanModel model{.process_intensity = 1.0, .initial_speed = 3.0, .huber = 1.345};
  KalmanFilter<1, 1> filter(model);
  for (int i = 0; i < 2; ++i) {
    filter.update(Scalar(0.0));
    filter.predict(1.0);
  }
  const double prior = filter.covariance()(0, 0);
  const double s = filter.innovation_covariance()(0, 0);
  KalmanFilter<1, 1> limit = filter;
  KalmanFilter<1, 1> outlier = filter;
  limit.update(Scalar(1.345 * std::sqrt(s)));
  outlier.update(Scalar(100.0));
  EXPECT_NEAR(outlier.estimate().position[0], limit.estimate().position[0], 1e-12);
  EXPECT_NEAR(outlier.estimate().velocity[0], limit.estimate().velocity[0], 1e-12);
  const double weight = 1.345 * std::sqrt(s) / 100.0;
  EXPECT_NEAR(outlier.covariance()(0, 0), prior - weight * prior * prior / s, 1e-12);
}

// Derived: the second measurement tells the velocity of a target that is far faster than one is at
// first sight: with P = diag(σ², v₀²) and T = 1 the gain on v is v₀² / (2σ² + v₀²), nothing less.
TEST(KalmanFilter, DoubtsNothingBeforeItKnowsTheVelocity) {
  const KalmanModel model{.process_intensity = 0.0, .initial_speed = 3.0, .huber = 1.345};
  KalmanFilter<1, 1> filter(model);
  filter.update(Scalar(0.0));
  filter.predict(1.0);
  filter.update(Scalar(100.0));
  EXPECT_NEAR(filter.estimate().velocity[0], 100.0 * 9.0 / 11.0, 1e-9);
}

// Property: a guess with a covariance is a start, too.
TEST(KalmanFilter, StartsFromAGuess) {
  Kinematics<1> guess;
  guess.position[0] = 10.0;
  guess.velocity[0] = 1.0;
  KalmanFilter<1, 1> filter({.sigma = 2.0, .process_intensity = 0.0}, guess,
                            Eigen::Matrix2d::Identity());
  filter.predict(1.0);
  EXPECT_EQ(filter.estimate().position[0], 11.0);
  filter.update(Scalar(17.0));
  EXPECT_NEAR(filter.estimate().position[0], 11.0 + 6.0 * 2.0 / (2.0 + 4.0), 1e-12);
}

}  // namespace
}  // namespace ghtrack

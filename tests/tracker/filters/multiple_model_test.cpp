#include "tracker/filters/multiple_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tracker/filters/filter.hpp"

namespace ghtrack {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kSigma = 0.5;
constexpr double kStep = 0.1;

MultipleModelFilter<2> cruising_or_turning(double switching = 0.01) {
  const auto with_noise = [](double intensity) {
    return KalmanFilter<1, 2>({.sigma = kSigma,
                               .interval = kStep,
                               .process_intensity = intensity,
                               .initial_speed = 10.0});
  };
  return MultipleModelFilter<2>({{"cruising", with_noise(0.1)}, {"turning", with_noise(20.0)}},
                                switching);
}

/// Flies straight on, and from second 6 to second 9 in a circle of 20 m/s².
Vector2d truth_at(double time) {
  constexpr double kSpeed = 10.0;
  constexpr double kTurnRate = 2.0;
  const double turned = kTurnRate * std::clamp(time - 6.0, 0.0, 3.0);
  const double radius = kSpeed / kTurnRate;
  const Vector2d direction(std::cos(turned), std::sin(turned));
  return Vector2d(kSpeed * std::min(time, 6.0), 0.0) +
         radius * Vector2d(std::sin(turned), 1.0 - std::cos(turned)) +
         kSpeed * std::max(0.0, time - 9.0) * direction;
}

// Derived: Bayes' rule by hand, with each filter's own innovation before the update.
TEST(MultipleModel, WeighsByTheLikelihoodOfTheInnovations) {
  constexpr double kSwitching = 0.05;
  MultipleModelFilter<2> filter = cruising_or_turning(kSwitching);
  const Matrix2d r{{0.3, 0.05}, {0.05, 0.2}};
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, kSigma);
  for (int i = 0; i < 90; ++i) {
    const Vector2d truth = truth_at(kStep * i);
    const double dx = noise(random);
    const double dy = noise(random);
    const Vector2d z = truth + Vector2d(dx, dy);
    filter.predict(kStep);
    if (!filter.is_started()) {
      filter.update(z, r);
      continue;
    }
    std::vector<double> expected;
    for (const MultipleModelFilter<2>::Model& model : filter.models()) {
      const auto& kalman = std::get<KalmanFilter<1, 2>>(model.filter);
      const Matrix2d s = kalman.innovation_covariance(r);
      const Vector2d residual = z - kalman.estimate().position;
      const double prior = (1.0 - kSwitching) * model.weight + kSwitching * (1.0 - model.weight);
      expected.push_back(prior * std::exp(-0.5 * residual.dot(s.inverse() * residual)) /
                         (2.0 * std::numbers::pi * std::sqrt(s.determinant())));
    }
    ASSERT_TRUE(filter.update(z, r));
    const double sum = expected[0] + expected[1];
    EXPECT_NEAR(filter.models()[0].weight, expected[0] / sum, 1e-12);
    EXPECT_NEAR(filter.models()[1].weight, expected[1] / sum, 1e-12);
  }
}

// Property: who leads follows how the target moves, and back again.
TEST(MultipleModel, LetsTheFilterLeadThatTheTargetMovesLike) {
  MultipleModelFilter<2> filter = cruising_or_turning();
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, kSigma);
  int right = 0;
  int judged = 0;
  for (int i = 0; i < 150; ++i) {
    const double time = kStep * i;
    const double dx = noise(random);
    const double dy = noise(random);
    filter.predict(kStep);
    filter.update(truth_at(time) + Vector2d(dx, dy));
    const bool is_turning = time >= 6.0 && time <= 9.0;
    const bool is_transient =
        time < 2.0 || (time >= 6.0 && time < 6.6) || (time > 9.0 && time < 11);
    if (is_transient) continue;
    ++judged;
    right += filter.leader().name == (is_turning ? "turning" : "cruising") ? 1 : 0;
  }
  EXPECT_GE(right, judged * 9 / 10) << judged;
}

// Derived: covariance about the leader Σ μ (P + d dᵀ).
TEST(MultipleModel, CountsWhatTheOthersPredictElsewhereAsUncertainty) {
  MultipleModelFilter<2> filter = cruising_or_turning();
  for (int i = 0; i < 75; ++i) {
    filter.predict(kStep);
    filter.update(truth_at(kStep * i));
  }
  filter.predict(kStep);
  Matrix2d expected = Matrix2d::Zero();
  for (const MultipleModelFilter<2>::Model& model : filter.models()) {
    const auto& kalman = std::get<KalmanFilter<1, 2>>(model.filter);
    const Vector2d d = kalman.estimate().position - filter.estimate().position;
    expected += model.weight * (kalman.covariance().topLeftCorner<2, 2>() + d * d.transpose());
  }
  EXPECT_TRUE(filter.innovation_covariance(Matrix2d::Zero()).isApprox(expected, 1e-12));
  EXPECT_TRUE(filter.position_sigma().isApprox(expected.diagonal().cwiseSqrt(), 1e-12));
}

// Property: one model alone is that filter.
TEST(MultipleModel, OfOneModelIsThatFilter) {
  const KalmanFilter<1, 2> kalman({.sigma = kSigma, .initial_speed = 5.0});
  MultipleModelFilter<2> one({{"only", kalman}}, 0.1);
  KalmanFilter<1, 2> alone = kalman;
  for (int i = 0; i < 30; ++i) {
    one.predict(kStep);
    alone.predict(kStep);
    one.update(truth_at(kStep * i));
    alone.update(truth_at(kStep * i));
    EXPECT_EQ(one.estimate().position, alone.estimate().position);
    EXPECT_EQ(one.leader().weight, 1.0);
  }
}

// Property: a measurement far beyond what any model can explain leaves the weights finite.
TEST(MultipleModel, KeepsItsWeightsUnderAbsurdMeasurements) {
  MultipleModelFilter<2> filter = cruising_or_turning();
  for (int i = 0; i < 20; ++i) {
    filter.predict(kStep);
    filter.update(truth_at(kStep * i));
  }
  for (const double far : {1e150, -1e300, 1e308}) {
    filter.predict(kStep);
    filter.update(Vector2d(far, far));
    double sum = 0.0;
    for (const MultipleModelFilter<2>::Model& model : filter.models()) sum += model.weight;
    EXPECT_NEAR(sum, 1.0, 1e-9);
    EXPECT_TRUE(filter.estimate().is_finite());
  }
}

// Property: what has no meaning is refused where the filter is made.
TEST(MultipleModel, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(MultipleModelFilter<2>({}, 0.01), std::invalid_argument);
  EXPECT_THROW(cruising_or_turning(0.7), std::invalid_argument);
  EXPECT_THROW(cruising_or_turning(std::nan("")), std::invalid_argument);
  EXPECT_THROW(make_filter(MultipleModelConfig{}, 0.5, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace ghtrack

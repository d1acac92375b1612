#include "tools/metrics/error_floor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr double kSigma = 2.0;
constexpr double kPeriod = 0.5;

// Derived: a target whose acceleration is white from step to step, with tracking index λ = 1, is
// followed best by g = 1 − r², r = (4 + λ − √(8λ + λ²)) / 4, with variance g σ² per axis (Kalata
// 1984). Choosing among neighbours of that filter afterwards gains next to nothing; 3 % covers
// 20000 correlated errors.
TEST(FloorFilters, ReachTheLeastErrorOfARandomManoeuvre) {
  FloorFilters filters(kSigma, kPeriod);
  Stream random(1, Purpose::kGeneration, 0, 0);
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  FloorFilters::Values sums{};
  constexpr int kSteps = 20000;
  constexpr int kStart = 100;
  for (int i = 0; i < kSteps + kStart; ++i) {
    Vec2 acceleration, noise;
    for (int axis = 0; axis < 2; ++axis) {
      acceleration[axis] = kSigma / (kPeriod * kPeriod) * random.normal();
      noise[axis] = kSigma * random.normal();
    }
    position += kPeriod * velocity + 0.5 * kPeriod * kPeriod * acceleration;
    velocity += kPeriod * acceleration;
    const Detection detection{.position = position + noise,
                              .covariance = kSigma * kSigma * Eigen::Matrix2d::Identity(),
                              .label = {}};
    filters.step(kPeriod * i, &detection);
    if (i < kStart) continue;
    const FloorFilters::Values squares = *filters.squared_errors(position);
    for (std::size_t k = 0; k < squares.size(); ++k) sums[k] += squares[k] / kSteps;
  }
  const double least = std::sqrt(*std::min_element(sums.begin(), sums.end()));
  EXPECT_NEAR(least / (kSigma * std::sqrt(2.0 * 0.75)), 1.0, 0.03);
}

// Derived: on a noiseless straight line every filter is right from its third detection on, through
// misses too.
TEST(FloorFilters, FollowAStraightLineThroughMisses) {
  FloorFilters filters(kSigma, kPeriod);
  for (int i = 0; i < 60; ++i) {
    const Vec2 position(3.0 * i, -1.0 * i);
    const Detection detection{
        .position = position, .covariance = 1e-8 * Eigen::Matrix2d::Identity(), .label = {}};
    filters.step(kPeriod * i, i % 7 == 5 ? nullptr : &detection);
    EXPECT_EQ(filters.squared_errors(position).has_value(), i >= 2);
    if (i < 2) continue;
    const FloorFilters::Values squares = *filters.squared_errors(position);
    for (const double square : squares) EXPECT_LT(square, 1e-4);
  }
}

// Property: detections whose error is alike in all directions are followed as any others: where it
// is a little longer in one of them, in all scans or from one on, errors differ as little.
TEST(FloorFilters, TreatRoundErrorsAsAnyOthers) {
  for (const int first_slanted : {0, 1, 17}) {
    FloorFilters round(kSigma, kPeriod);
    FloorFilters slanted(kSigma, kPeriod);
    Stream random(2, Purpose::kGeneration, 0, 0);
    for (int i = 0; i < 60; ++i) {
      const Vec2 truth(0.5 * i * i, 20.0 * std::sin(0.2 * i));
      Detection detection{.position = truth,
                          .covariance = kSigma * kSigma * Eigen::Matrix2d::Identity(),
                          .label = {}};
      detection.position.x() += kSigma * random.normal();
      detection.position.y() += kSigma * random.normal();
      const bool is_missed = i % 5 == 4;
      round.step(kPeriod * i, is_missed ? nullptr : &detection);
      if (i >= first_slanted) detection.covariance(0, 0) *= 1.0 + 1e-9;
      slanted.step(kPeriod * i, is_missed ? nullptr : &detection);
      const auto one = round.squared_errors(truth);
      const auto other = slanted.squared_errors(truth);
      ASSERT_EQ(one.has_value(), other.has_value());
      for (std::size_t k = 0; one && k < one->size(); ++k) {
        EXPECT_NEAR((*one)[k], (*other)[k], 1e-5 * (1.0 + (*one)[k])) << "filter " << k;
      }
    }
  }
}

// Derived: errors wait until the tracker speaks about the same scan; scans it skips are forgotten.
TEST(ErrorFloor, AnswersForTheScanThatIsAskedFor) {
  ErrorFloor floor(2, kSigma, kPeriod);
  for (int i = 0; i < 10; ++i) {
    TruthSnapshot truth;
    truth.time = kPeriod * i;
    truth.objects.resize(1);
    truth.objects[0].id = 1;
    Observation observation;
    observation.scan.time = truth.time;
    observation.scan.detections.resize(2);
    observation.origins = {kClutterOrigin, 1};
    floor.add_observation(truth, observation);
  }
  EXPECT_FALSE(floor.squared_errors(1).has_value());
  floor.go_to(kPeriod * 5, 0);
  EXPECT_TRUE(floor.squared_errors(1).has_value());
  EXPECT_FALSE(floor.squared_errors(0).has_value());
  floor.go_to(kPeriod * 4, 0);
  EXPECT_FALSE(floor.squared_errors(1).has_value());
  floor.go_to(kPeriod * 9, 0);
  EXPECT_TRUE(floor.squared_errors(1).has_value());
}

}  // namespace
}  // namespace ghtrack

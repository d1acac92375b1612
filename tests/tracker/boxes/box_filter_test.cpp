#include "tracker/boxes/box_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr BoxNoise kNoise{.place = 0.01, .size = 0.04, .velocity = 0.09};

// Derived: two squares of side 2 that share a unit square: 1 / (4 + 4 - 1).
TEST(BoundingBox, OverlapIsIntersectionOverUnion) {
  const BoundingBox a{Vector2d(0, 0), Vector2d(2, 2)};
  EXPECT_DOUBLE_EQ(overlap(a, {Vector2d(1, 1), Vector2d(2, 2)}), 1.0 / 7.0);
  EXPECT_DOUBLE_EQ(overlap(a, a), 1.0);
  EXPECT_DOUBLE_EQ(overlap(a, {Vector2d(2, 0), Vector2d(2, 2)}), 0.0);
  EXPECT_DOUBLE_EQ(overlap(a, {Vector2d(0, 0), Vector2d(1, 1)}), 0.25);
}

// Derived: after one image P = R + V, so a box one scale beside the prediction is at the squared
// distance 1 / (2 R + V).
TEST(BoxFilter, MeasuresDistanceInScalesOfTheBox) {
  BoxEstimate estimate = begin_estimate(kNoise, {Vector2d(0, 0), Vector2d(20, 80)});
  predict(kNoise, {}, 1.0, estimate);
  const BoxResidual there = residual(kNoise, estimate, {Vector2d(40, 0), Vector2d(22, 80)});
  EXPECT_NEAR(there.place_distance, 1.0 / 0.11, 1e-12);
  EXPECT_NEAR(there.size_distance, 0.01 / 0.08, 1e-12);
}

// Derived: x += P / (P + 1.5 R) r, v += V / (P + 1.5 R) r one image after the first box.
TEST(BoxFilter, CorrectsByTheGainsOfItsError) {
  BoxEstimate estimate = begin_estimate(kNoise, {Vector2d(0, 0), Vector2d(40, 40)});
  predict(kNoise, {}, 1.0, estimate);
  const BoxResidual there = residual(kNoise, estimate, {Vector2d(8, 0), Vector2d(44, 40)});
  correct(kNoise, there, estimate);
  EXPECT_NEAR(estimate.box.centre.x(), 8.0 * 0.10 / 0.115, 1e-12);
  EXPECT_NEAR(estimate.velocity.x(), 8.0 * 0.09 / 0.115, 1e-12);
  EXPECT_NEAR(estimate.motion.xx, 0.10 * 0.015 / 0.115, 1e-12);
  EXPECT_NEAR(estimate.box.size.x(), 42.0, 1e-12);
}

}  // namespace
}  // namespace ghtrack

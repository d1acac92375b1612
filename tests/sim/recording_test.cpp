#include "sim/regimes/recording.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

// Derived: the spline through four or more places of a cubic is the cubic, whatever their
// distances; through three of a parabola the parabola.
TEST(Recording, IsExactForCubics) {
  Recording recording;
  for (const double t : {2.0, 2.5, 4.0, 4.2, 7.0}) {
    const double s = t - 2.0;
    recording.places.push_back({t, 1.0 + 2.0 * s - 0.5 * s * s + 0.1 * s * s * s, -3.0 * s});
  }
  World world(world_of({target_of(recording)}), 1);
  for (const double s : {0.0, 0.3, 1.1, 2.1, 4.9}) {
    const TruthState state = state_at(world, s);
    EXPECT_LT(
        (state.position - Vec2(1.0 + 2.0 * s - 0.5 * s * s + 0.1 * s * s * s, -3.0 * s)).norm(),
        1e-12);
    EXPECT_LT((state.velocity - Vec2(2.0 - s + 0.3 * s * s, -3.0)).norm(), 1e-12);
    EXPECT_LT((state.acceleration - Vec2(-1.0 + 0.6 * s, 0.0)).norm(), 1e-12);
  }
  // Beyond its last row it keeps its velocity.
  const double last = 2.0 - 5.0 + 0.3 * 25.0;
  EXPECT_NEAR(state_at(world, 6.0).velocity.x(), last, 1e-12);
  EXPECT_EQ(state_at(world, 6.0).acceleration, Vec2::Zero());
}

// Derived: 5/384 X h⁴, X h³/24 and 3/8 X h² (Hall & Meyer 1976), away from the ends, for a circle.
TEST(Recording, KeepsTheErrorBoundsOfItsSpline) {
  constexpr double kRadius = 50.0;
  constexpr double kRate = 0.4;
  constexpr double kStep = 0.5;
  Recording recording;
  for (int i = 0; i <= 40; ++i) {
    const double angle = kRate * kStep * i;
    recording.places.push_back({kStep * i, kRadius * std::cos(angle), kRadius * std::sin(angle)});
  }
  World world(world_of({target_of(recording)}), 1);
  const double fourth = kRadius * std::pow(kRate, 4);
  for (double t = 4.0; t < 16.0; t += 0.0371) {
    const TruthState state = state_at(world, t);
    const Vec2 out(std::cos(kRate * t), std::sin(kRate * t));
    const Vec2 along(-out.y(), out.x());
    const auto worst = [](const Vec2& v) { return v.cwiseAbs().maxCoeff(); };
    EXPECT_LT(worst(state.position - kRadius * out), 5.0 / 384.0 * fourth * std::pow(kStep, 4));
    EXPECT_LT(worst(state.velocity - kRadius * kRate * along), fourth * std::pow(kStep, 3) / 24.0);
    EXPECT_LT(worst(state.acceleration + kRadius * kRate * kRate * out),
              0.375 * fourth * kStep * kStep);
  }
}

// Property: one place stands, two make a straight; both drift with the velocity that is added.
TEST(Recording, WorksWithFewPlaces) {
  Recording recording;
  recording.places = {{5.0, 1.0, 2.0}};
  recording.velocity = Vec2(0.5, 0.0);
  World one(world_of({target_of(recording)}), 1);
  EXPECT_EQ(state_at(one, 2.0).position, Vec2(2.0, 2.0));
  recording.places.push_back({7.0, 5.0, 2.0});
  World two(world_of({target_of(recording)}), 1);
  EXPECT_EQ(state_at(two, 1.0).position, Vec2(3.5, 2.0));
  EXPECT_EQ(state_at(two, 1.0).velocity, Vec2(2.5, 0.0));
}

}  // namespace
}  // namespace ghtrack

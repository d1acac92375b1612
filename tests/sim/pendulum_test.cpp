#include "sim/regimes/pendulum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/portable_math.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

Pendulum hanging(double length, double angle_deg, double rate_deg = 0.0) {
  Pendulum pendulum;
  pendulum.length = length;
  pendulum.angle_deg = angle_deg;
  pendulum.rate_deg = rate_deg;
  return pendulum;
}

/// The arithmetic-geometric mean.
double agm(double a, double b) {
  while (std::abs(a - b) > 1e-15 * a) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return a;
}

// Derived: the period is 2π √(l/g) / agm(1, cos(θ₀/2)) (Gauss), at small angles and at large ones.
TEST(Pendulum, SwingsWithGausssPeriod) {
  for (const double angle : {1.0, 45.0, 120.0, 179.0}) {
    const double period = 2.0 * portable::kPi * std::sqrt(2.0 / kStandardGravity) /
                          agm(1.0, std::cos(0.5 * angle * portable::kPi / 180.0));
    World world(world_of({target_of(hanging(2.0, angle))}), 1);
    const Vec2 start = state_at(world, 0.0).position;
    EXPECT_LT((state_at(world, 0.5 * period).position - Vec2(-start.x(), start.y())).norm(), 1e-7);
    EXPECT_LT((state_at(world, 3.0 * period).position - start).norm(), 1e-7) << angle;
  }
}

// Property: without damping the energy stays what it was, in swings and over the top; the rod keeps
// its length.
TEST(Pendulum, KeepsItsEnergyForAnHour) {
  for (const Pendulum& pendulum : {hanging(5.0, 150.0), hanging(1.0, 0.0, 500.0)}) {
    World world(world_of({target_of(pendulum)}), 1);
    const auto energy = [](const TruthState& state) {
      return 0.5 * state.velocity.squaredNorm() + kStandardGravity * state.position.y();
    };
    const double begun = energy(state_at(world, 0.0));
    for (const double time : {1.0, 60.0, 3600.0}) {
      const TruthState state = state_at(world, time);
      EXPECT_NEAR(energy(state), begun, 1e-9 * pendulum.length * kStandardGravity) << time;
      EXPECT_NEAR(state.position.norm(), pendulum.length, 1e-12);
    }
  }
}

// Derived: small swings with damping c die away as e^(−ct/2), with the frequency √(g/l − c²/4).
TEST(Pendulum, DampsSmallSwings) {
  Pendulum pendulum = hanging(2.0, 0.01);
  pendulum.damping = 0.4;
  const double frequency = std::sqrt(kStandardGravity / 2.0 - 0.04);
  World world(world_of({target_of(pendulum)}), 1);
  const double start = state_at(world, 0.0).position.x();
  for (const double t : {0.7, 3.0, 8.0}) {
    const double wanted = start * std::exp(-0.2 * t) *
                          (std::cos(frequency * t) + 0.2 / frequency * std::sin(frequency * t));
    EXPECT_NEAR(state_at(world, t).position.x(), wanted, 1e-7 * start);
  }
}

}  // namespace
}  // namespace ghtrack

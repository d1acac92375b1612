#include "sim/regimes/balloon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/portable_math.hpp"
#include "sim/world.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

// T16. Derived: v = √(2 (ρ V − m) g / (ρ C_d π R²)) = 2.214 m/s for the 11-inch balloon.
TEST(Balloon, RisesAtItsTerminalSpeed) {
  World world(world_of({target_of(Balloon{})}), 1);
  EXPECT_NEAR(state_at(world, 5.0).velocity.y(), 2.2141, 0.0001);
}

// Derived: with the added mass C_a ρ V the initial acceleration is (ρ V − m) g / (m + C_a ρ V);
// without it a balloon would jump at two and a half times that.
TEST(Balloon, CarriesTheAirAroundItAlong) {
  const Balloon balloon;
  World world(world_of({target_of(balloon)}), 1);
  const double volume = 4.0 / 3.0 * portable::kPi * std::pow(balloon.radius, 3);
  const double mass = balloon.envelope_mass + balloon.gas_density * volume;
  EXPECT_NEAR(state_at(world, 0.0).acceleration.y(),
              (1.2 * volume - mass) * kStandardGravity / (mass + 0.6 * volume), 1e-9);
}

// T17. Property: quasi-steady drag never makes a balloon faster than the wind. With its own mass
// only and explicit drag at 60 Hz the speed oscillates up to 120 m/s.
TEST(Balloon, IsNeverFasterThanAGust) {
  for (const double rate : {60.0, 240.0}) {
    WorldConfig config = world_of({target_of(Balloon{})});
    config.environment.gravity = 0.0;
    config.environment.wind.gusts.emplace_back(StepGust{0.51, Vec2(60.0, 0.0)});
    config.physics.rate = rate;
    World world(config, 1);
    double fastest = 0.0;
    for (int i = 0; i < 400; ++i) {
      fastest = std::max(fastest, state_at(world, 0.005 * i).velocity.x());
    }
    EXPECT_LE(fastest, 60.0);
    EXPECT_GT(fastest, 59.5);
  }
}

// Property: the pressure field of accelerating air makes it overshoot (by 8 % here).
TEST(Balloon, OvershootsASmoothGustWithFluidAcceleration) {
  Balloon balloon;
  balloon.fluid_acceleration = true;
  WorldConfig config = world_of({target_of(balloon)});
  config.environment.gravity = 0.0;
  config.environment.wind.gusts.emplace_back(OneMinusCosineGust{0.5, 1.2, Vec2(30.0, 0.0)});
  World world(config, 1);
  double fastest = 0.0;
  for (int i = 0; i < 400; ++i) {
    fastest = std::max(fastest, state_at(world, 0.01 * i).velocity.x());
  }
  EXPECT_NEAR(fastest, 32.5, 0.3);
}

// Property: close balloons feel the same gusts, distant ones their own.
TEST(Balloon, SharesGustsWithItsNeighbours) {
  std::vector<Target> targets;
  for (const double x : {0.0, 0.5, 400.0}) {
    Balloon balloon;
    balloon.position = Vec2(x, 10.0);
    targets.push_back(target_of(balloon));
  }
  WorldConfig config = world_of(targets);
  config.environment.gravity = 0.0;
  config.environment.wind.turbulence.model = OrnsteinUhlenbeck{5.0, 1.0, 50.0};
  World world(config, 3);
  double near = 0.0;
  double far = 0.0;
  for (int i = 1; i <= 100; ++i) {
    const TruthSnapshot truth = world.sample(0.1 * i);
    near += (truth.objects[1].velocity - truth.objects[0].velocity).squaredNorm();
    far += (truth.objects[2].velocity - truth.objects[0].velocity).squaredNorm();
  }
  EXPECT_LT(near, 0.01 * far);
}

// Property: a balloon that rises against a ceiling stays there; two that are blown together part.
TEST(Balloon, TouchesWallsAndOtherBalloons) {
  Balloon one;
  Balloon other;
  other.position = Vec2(1.0, 0.0);
  one.velocity = Vec2(3.0, 0.0);
  WorldConfig config = world_of({target_of(one), target_of(other)});
  config.environment.walls = {Wall{Vec2(-10.0, 4.0), Vec2(10.0, 4.0), {}, {}}};
  World world(config, 1);
  for (int i = 0; i <= 200; ++i) {
    const TruthSnapshot truth = world.sample(0.05 * i);
    const double distance = (truth.objects[1].position - truth.objects[0].position).norm();
    EXPECT_GT(distance, 0.28 - 0.005) << i;
  }
  for (const TruthState& state : world.sample(10.0).objects) {
    EXPECT_NEAR(state.position.y(), 4.0 - one.radius, 1e-6);
  }
}

}  // namespace
}  // namespace ghtrack

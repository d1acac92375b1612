#include "sim/regimes/drone.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/world.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

Drone drone_with(std::vector<FlightOrder> plan) {
  Drone drone;
  drone.position = Vec2(0.0, 30.0);
  drone.plan = std::move(plan);
  return drone;
}

double drag_per_mass(const Drone& drone) { return 0.5 * 1.2 * drone.drag_area / drone.mass; }

// Derived: hovering in a steady wind w the tilt balances the drag, tan θ = k w² / g, and the drone
// stays where it is.
TEST(Drone, LeansIntoTheWindToHover) {
  const Drone drone = drone_with({});
  WorldConfig config = world_of({target_of(drone)});
  config.environment.wind.mean = Vec2(10.0, 0.0);
  World world(config, 1);
  const TruthSnapshot truth = world.sample(30.0);
  EXPECT_LT((truth.objects.at(0).position - drone.position).norm(), 1e-3);
  EXPECT_NEAR(std::tan(truth.bodies.at(0).angle), drag_per_mass(drone) * 100.0 / kStandardGravity,
              1e-6);
}

// Derived: a wind stronger than √(g tan θ_max / k) = 20 m/s blows it away; what is left of the
// speed through the air is exactly that.
TEST(Drone, IsBlownAwayByAWindBeyondItsLargestTilt) {
  const Drone drone = drone_with({});
  WorldConfig config = world_of({target_of(drone)});
  config.environment.wind.mean = Vec2(30.0, 0.0);
  World world(config, 1);
  const double hold = std::sqrt(kStandardGravity * std::tan(35.0 * 3.141592653589793 / 180.0) /
                                drag_per_mass(drone));
  EXPECT_NEAR(hold, 20.0, 0.1);
  EXPECT_NEAR(state_at(world, 60.0).velocity.x(), 30.0 - hold, 1e-3);
}

// Property: it arrives at every place of its plan without passing it, no faster than its speed.
TEST(Drone, FliesToPlacesAndStopsThere) {
  const Drone drone = drone_with({{2.0, FlyTo{Vec2(60.0, 50.0)}}, {20.0, FlyTo{Vec2(0.0, 10.0)}}});
  World world(world_of({target_of(drone)}), 1);
  double fastest = 0.0;
  double farthest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const TruthState state = state_at(world, 0.1 * i);
    fastest = std::max(fastest, state.velocity.norm());
    farthest = std::max(farthest, state.position.x());
  }
  EXPECT_GT(fastest, 0.9 * drone.speed);
  EXPECT_LT(fastest, 1.05 * drone.speed);
  EXPECT_LT(farthest, 60.5);
  EXPECT_LT((state_at(world, 19.99).position - Vec2(60.0, 50.0)).norm(), 0.05);
  EXPECT_LT((state_at(world, 45.0).position - Vec2(0.0, 10.0)).norm(), 0.05);
}

// Derived: the velocity loop is a first-order lag; long after an order the velocity is the wanted
// one, whatever the wind within its power.
TEST(Drone, KeepsAVelocity) {
  WorldConfig config = world_of({target_of(drone_with({{0.0, KeepVelocity{Vec2(-6.0, 1.0)}}}))});
  config.environment.wind.mean = Vec2(5.0, 0.0);
  World world(config, 1);
  EXPECT_LT((state_at(world, 20.0).velocity - Vec2(-6.0, 1.0)).norm(), 1e-6);
}

// Derived: the attitude loop is of second order, so the tilt after a small step of the wanted
// velocity begins with a slope of zero: the drone cannot accelerate sideways at once. Without the
// loop the acceleration would be Δv/τ = 1.25 m/s² from the first instant.
TEST(Drone, MustTiltBeforeItAccelerates) {
  World world(world_of({target_of(drone_with({{1.0, KeepVelocity{Vec2(0.5, 0.0)}}}))}), 1);
  EXPECT_LT(std::abs(state_at(world, 1.001).acceleration.x()), 0.01);
  EXPECT_GT(state_at(world, 1.25).acceleration.x(), 0.5);
}

// Property: it lands, stays on the ground and takes off again.
TEST(Drone, LandsAndTakesOff) {
  WorldConfig config = world_of({target_of(
      drone_with({{0.0, KeepVelocity{Vec2(1.0, -3.0)}}, {20.0, FlyTo{Vec2(5.0, 12.0)}}}))});
  config.environment.ground = Ground{};
  World world(config, 1);
  const TruthState landed = state_at(world, 19.9);
  EXPECT_NEAR(landed.position.y(), 0.2, 1e-3);
  EXPECT_NEAR(landed.velocity.y(), 0.0, 1e-6);
  EXPECT_LT((state_at(world, 45.0).position - Vec2(5.0, 12.0)).norm(), 0.05);
}

// Property: seen from above it obeys the same plan, with at most the force of its largest tilt.
TEST(Drone, FliesInATopView) {
  WorldConfig config = world_of({target_of(drone_with({{0.0, FlyTo{Vec2(-40.0, 0.0)}}}))});
  config.environment.gravity = 0.0;
  World world(config, 1);
  EXPECT_LT((state_at(world, 30.0).position - Vec2(-40.0, 0.0)).norm(), 0.05);
}

// Property: halving the step of the physics moves it by less than a millimetre.
TEST(Drone, DoesNotDependOnThePhysicsRate) {
  WorldConfig config = world_of(
      {target_of(drone_with({{0.51, FlyTo{Vec2(30.0, 40.0)}}, {5.02, FlyTo{Vec2(0.0, 30.0)}}}))});
  config.environment.wind.mean = Vec2(4.0, 0.0);
  config.environment.wind.turbulence.model = Dryden{};
  World coarse(config, 1);
  config.physics.rate *= 2.0;
  World fine(config, 1);
  for (int i = 0; i < 100; ++i) {
    const double time = 0.1 * i;
    EXPECT_LT((state_at(coarse, time).position - state_at(fine, time).position).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace ghtrack

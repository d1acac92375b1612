#include "sim/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/world.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

const Ground kHill{.profile = {Vec2(0.0, 0.0), Vec2(10.0, 4.0), Vec2(30.0, 4.0), Vec2(40.0, -2.0)}};

// Derived: linear between the points, level beyond them.
TEST(Ground, HasTheHeightOfItsProfile) {
  EXPECT_EQ(kHill.height_at(-100.0), 0.0);
  EXPECT_EQ(kHill.height_at(0.0), 0.0);
  EXPECT_DOUBLE_EQ(kHill.height_at(5.0), 2.0);
  EXPECT_EQ(kHill.height_at(20.0), 4.0);
  EXPECT_DOUBLE_EQ(kHill.height_at(35.0), 1.0);
  EXPECT_EQ(kHill.height_at(1e5), -2.0);
  EXPECT_EQ(Ground{.height = 7.0}.height_at(3.0), 7.0);
}

// Property: balls that bounce and roll on a hilly ground never get below it.
TEST(Ground, CarriesBallsOverHills) {
  Target rain = target_of(plain_ball(Vec2(20.0, 15.0), Vec2(0.0, 0.0)), "drop");
  rain.random = RandomCopies{.count = 40, .area = Vec2(80.0, 8.0), .velocity = Vec2(12.0, 0.0)};
  WorldConfig config = world_of({rain});
  config.environment.ground = kHill;
  World world(config, 3);
  const double radius = ThrownBall{}.radius;
  for (int i = 0; i < 200; ++i) {
    for (const TruthState& state : world.sample(0.05 * i).objects) {
      ASSERT_GT(state.position.y(), kHill.height_at(state.position.x()) + 0.7 * radius) << i;
    }
  }
}

// Derived: without friction a ball slides down a slope of 45° with g sin 45° and goes on level with
// what it has when the slope bends away gently.
TEST(Ground, LetsABallSlideDownASlope) {
  ThrownBall ball = plain_ball(Vec2(0.0, 0.0), Vec2::Zero());
  ball.restitution = 0.0;
  ball.friction = 0.0;
  ball.position = Vec2(-ball.radius * std::sqrt(0.5), ball.radius * std::sqrt(0.5));
  ball.position += 1e-9 * Vec2(1.0, 1.0);
  WorldConfig config = world_of({target_of(ball)});
  config.environment.ground = Ground{.profile = {Vec2(-100.0, -100.0), Vec2(100.0, 100.0)}};
  World world(config, 1);
  const double expected = kStandardGravity * std::sqrt(0.5) * 2.0;
  EXPECT_NEAR(state_at(world, 2.0).velocity.norm(), expected, 1e-3);
}

// Derived: a ball thrown at the turned side of a box bounces as off a wall: at 45° a horizontal
// flight turns straight up, with restitution 1 and no friction at the same speed.
TEST(Box, TurnsABallUpwardsAtFortyFiveDegrees) {
  ThrownBall ball = plain_ball(Vec2(-5.0, 0.0), Vec2(10.0, 0.0));
  ball.restitution = 1.0;
  ball.friction = 0.0;
  WorldConfig config = world_of({target_of(ball)});
  config.environment.gravity = 0.0;
  config.environment.boxes = {
      SolidBox{.center = Vec2(0.0, 0.5), .size = Vec2(4.0, 4.0), .angle_deg = 45.0}};
  World world(config, 1);
  const Vec2 velocity = state_at(world, 1.0).velocity;
  EXPECT_NEAR(velocity.x(), 0.0, 1e-9);
  EXPECT_NEAR(std::abs(velocity.y()), 10.0, 1e-9);
}

// Property: a box contains its centre and its corners' insides, however it is turned.
TEST(Box, KnowsWhatIsInside) {
  for (const double angle : {0.0, 30.0, -77.0, 200.0}) {
    const SolidBox box{.center = Vec2(3.0, -2.0), .size = Vec2(4.0, 1.0), .angle_deg = angle};
    EXPECT_TRUE(box.contains(box.center));
    for (const Vec2& corner : box.corners()) {
      EXPECT_TRUE(box.contains(box.center + 0.999 * (corner - box.center)));
      EXPECT_FALSE(box.contains(box.center + 1.001 * (corner - box.center)));
    }
  }
}

// Property: the first material says nothing, the others are within what a key allows.
TEST(Material, HasPlausibleNumbers) {
  EXPECT_FALSE(materials().front().restitution || materials().front().friction);
  for (const Material& material : materials().subspan(1)) {
    EXPECT_GT(material.friction.value_or(-1.0), 0.0) << material.name;
    EXPECT_LE(material.restitution.value_or(1.0), 1.0) << material.name;
  }
}

// Derived: FIFA's ball drop on natural turf, 0.6 to 0.85 m after 2 m.
TEST(Material, GrassLetsAFootballRiseAsItShould) {
  ThrownBall ball;
  for (const ThrownBall& preset : ThrownBall::presets()) {
    if (preset.type == "soccer") ball = preset;
  }
  ball.position = Vec2(0.0, 2.0 + ball.radius);
  WorldConfig config = world_of({target_of(ball)});
  config.environment.ground = surfaces_of_all_materials<Ground>()[6];
  ASSERT_EQ(config.environment.ground->material, "grass");
  World world(config, 1);
  double highest = 0.0;
  for (int i = 70; i < 140; ++i) {
    highest = std::max(highest, state_at(world, 0.01 * i).position.y() - ball.radius);
  }
  EXPECT_GT(highest, 0.6);
  EXPECT_LT(highest, 0.85);
}

}  // namespace
}  // namespace ghtrack

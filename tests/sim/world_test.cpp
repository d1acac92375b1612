#include "sim/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "tests/sim/golden_worlds.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

// T3. Derived: x = x0 + v t, y = y0 + v t − g t²/2. Plain Box2D at 60 Hz: 0.41 m off after 5 s.
TEST(World, DropsABallOnAParabolaInAVacuum) {
  ThrownBall ball;
  ball.position = Vec2(0.0, 1.0);
  ball.velocity = Vec2(30.0, 20.0);
  WorldConfig config = world_of({target_of(ball)});
  config.environment.air.density = 0.0;
  World world(config, 1);
  const TruthState state = state_at(world, 5.0);
  EXPECT_NEAR(state.position.x(), 150.0, 1e-3);
  EXPECT_NEAR(state.position.y(), 1.0 + 100.0 - 0.5 * kStandardGravity * 25.0, 1e-3);
  EXPECT_NEAR(state.acceleration.y(), -kStandardGravity, 1e-12);
}

// T2. Derived: uniform motion. In single precision at 23 km Box2D is 23 m off after ten minutes at
// 5 m/s, and 0.05 m/s does not move at all.
TEST(World, KeepsSlowTrainsExactFarFromTheOrigin) {
  for (const double speed : {0.05, 5.0, 13.7}) {
    World world(world_of({target_of(single_car(23000.0, speed))}), 1);
    const TruthState state = state_at(world, 600.0);
    EXPECT_NEAR(state.position.x(), 23000.0 + 600.0 * speed, 1e-3) << speed;
    EXPECT_EQ(state.velocity.x(), speed);
  }
}

// T1. Derived: uniform motion. Box2D clips motion at 2 m a step: 83 m/s becomes 60 m/s at 30 Hz.
TEST(World, KeepsSpeedsAboveBox2dsLimit) {
  for (const double rate : {30.0, 240.0}) {
    for (const double speed : {83.0, 119.0}) {
      WorldConfig config = world_of({target_of(single_car(0.0, speed)),
                                     target_of(plain_ball(Vec2(0.0, 50.0), Vec2(speed, 0.0)))});
      config.environment.gravity = 0.0;
      config.physics.rate = rate;
      World world(config, 1);
      for (const TruthState& state : world.sample(10.0).objects) {
        EXPECT_NEAR(state.velocity.x(), speed, 1e-12);
        EXPECT_NEAR(state.position.x(), 10.0 * speed, 1e-9);
      }
    }
  }
}

// T9. Property: momentum is conserved and every pair meets, whatever the phase of the impact within
// a step; the heavier ball stands still. Without continuous collision, 49 of 500 hit at 60 Hz.
TEST(World, LetsNoBallSlipThroughAnother) {
  for (int phase = 0; phase < 500; ++phase) {
    ThrownBall thrown = plain_ball(Vec2(-10.0 - 0.75 * phase / 500.0, 0.01), Vec2(45.0, 0.0));
    ThrownBall resting = plain_ball(Vec2::Zero(), Vec2::Zero());
    resting.mass = 0.3;
    WorldConfig config = world_of({target_of(thrown), target_of(resting)});
    config.environment.gravity = 0.0;
    config.physics.rate = 60.0;
    World world(config, 1);
    const TruthSnapshot truth = world.sample(0.5);
    const Vec2 momentum =
        thrown.mass * truth.objects[0].velocity + resting.mass * truth.objects[1].velocity;
    ASSERT_GT(truth.objects[1].velocity.x(), 1.0) << phase;
    ASSERT_NEAR(momentum.x(), thrown.mass * 45.0, 1e-3) << phase;
    ASSERT_NEAR(momentum.y(), 0.0, 1e-3) << phase;
  }
}

// Derived: e = √(e1 e2) of the closing speed, along the line of centres.
TEST(World, BouncesBallsOffEachOtherWithTheirRestitution) {
  ThrownBall left = plain_ball(Vec2(-1.0, 0.0), Vec2(10.0, 0.0));
  ThrownBall right = plain_ball(Vec2(1.0, 0.0), Vec2(-10.0, 0.0));
  left.restitution = 0.5;
  right.restitution = 0.8;
  WorldConfig config = world_of({target_of(left), target_of(right)});
  config.environment.gravity = 0.0;
  World world(config, 1);
  const TruthSnapshot truth = world.sample(0.2);
  const double wanted = 10.0 * std::sqrt(0.4);
  EXPECT_NEAR(truth.objects[0].velocity.x(), -wanted, 1e-4);
  EXPECT_NEAR(truth.objects[1].velocity.x(), wanted, 1e-4);
}

// Property: a ball is thrown back by a train as by a wall that moves, and the train does not mind.
TEST(World, ThrowsABallBackFromAMovingTrain) {
  ThrownBall ball = plain_ball(Vec2(60.0, 0.0), Vec2(-10.0, 0.0));
  WorldConfig config = world_of({target_of(single_car(0.0, 20.0)), target_of(ball)});
  config.environment.gravity = 0.0;
  World world(config, 1);
  const TruthSnapshot truth = world.sample(2.5);
  const double restitution = std::sqrt(0.3 * ball.restitution);
  EXPECT_EQ(truth.objects[0].velocity.x(), 20.0);
  EXPECT_NEAR(truth.objects[1].velocity.x(), 20.0 + restitution * 30.0, 0.01);
}

// Property: between two steps the truth continues both.
TEST(World, InterpolatesBetweenSteps) {
  ThrownBall ball;
  ball.velocity = Vec2(30.0, 10.0);
  WorldConfig config = world_of({target_of(ball)});
  config.physics.rate = 30.0;
  World coarse(config, 1);
  config.physics.rate = 1000.0;
  World fine(config, 1);
  for (int i = 0; i < 200; ++i) {
    const double time = i * 0.00731;
    EXPECT_LT((state_at(coarse, time).position - state_at(fine, time).position).norm(), 1e-5);
  }
}

// Property: nothing of the truth is a negative zero, which reads as if it moved downwards.
TEST(World, KnowsNoNegativeZero) {
  WorldConfig config = busy_world();
  config.targets.push_back(target_of(plain_ball(Vec2(-300.0, 0.12), Vec2::Zero()), "at rest"));
  World world(config, 1);
  for (int i = 0; i <= 40; ++i) {
    for (const TruthState& state : world.sample(0.1 * i).objects) {
      for (const Vec2& v : {state.position, state.velocity, state.acceleration}) {
        EXPECT_FALSE(v.x() == 0.0 && std::signbit(v.x())) << state.id;
        EXPECT_FALSE(v.y() == 0.0 && std::signbit(v.y())) << state.id;
      }
    }
  }
}

// Property: targets that do not touch do not know of each other, bit for bit, wherever in the list
// a new one is inserted.
TEST(World, IsNotChangedForOthersByOneMoreTarget) {
  WorldConfig config = busy_world();
  World before(config, 7);
  ThrownBall far;
  far.position = Vec2(-500.0, 1.0);
  far.velocity = Vec2(3.0, 30.0);
  Balloon lonely;
  lonely.position = Vec2(-300.0, 40.0);
  config.targets.insert(config.targets.begin(), target_of(lonely, "a balloon elsewhere"));
  config.targets.insert(config.targets.begin() + 4, target_of(far, "a ball elsewhere"));
  World after(config, 7);
  const auto by_name = [](World& world, double time) {
    std::map<std::string, TruthState> states;
    for (const TruthState& state : world.sample(time).objects) {
      states[world.objects()[static_cast<std::size_t>(state.id)].name] = state;
    }
    return states;
  };
  for (int i = 0; i <= 40; ++i) {
    std::map<std::string, TruthState> crowded = by_name(after, 0.1 * i);
    for (const auto& [name, state] : by_name(before, 0.1 * i)) {
      ASSERT_EQ(crowded[name].position, state.position) << name << " at " << 0.1 * i;
      ASSERT_EQ(crowded[name].velocity, state.velocity) << name << " at " << 0.1 * i;
    }
  }
}

// Property: an object is absent until it appears and after it disappears; its motion begins then.
TEST(World, ShowsATargetOnlyWhileItIsThere) {
  Target late = target_of(plain_ball(Vec2::Zero(), Vec2(10.0, 0.0)), "late");
  late.appears = 1.003;
  late.disappears = 2.0;
  World world(world_of({late}), 1);
  EXPECT_TRUE(world.sample(1.0).objects.empty());
  EXPECT_NEAR(state_at(world, 1.503).position.x(), 5.0, 1e-9);
  EXPECT_TRUE(world.sample(2.0).objects.empty());
}

// Property: names are completed by kind and number, around names that are taken.
TEST(World, NamesTheNameless) {
  std::vector<Target> targets{target_of(ThrownBall{}), target_of(Balloon{}),
                              target_of(ThrownBall{}), target_of(ThrownBall{}, "ball 3"),
                              target_of(ThrownBall{})};
  name_targets(targets);
  EXPECT_EQ(targets[0].name, "ball 1");
  EXPECT_EQ(targets[1].name, "balloon 1");
  EXPECT_EQ(targets[2].name, "ball 2");
  EXPECT_EQ(targets[4].name, "ball 4");
}

// Property: what Box2D could not survive is refused in words.
TEST(World, RefusesTargetsThatCannotExistTogether) {
  const ThrownBall ball = plain_ball(Vec2(1.0, 1.0), Vec2::Zero());
  ThrownBall close = ball;
  close.position.x() += 0.05;
  const std::vector<TargetProblem> problems = find_problems(
      {target_of(ball, "a"), target_of(close, "b"), target_of(single_car(0.0, 1.0), "a")});
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].target, 2u);
  EXPECT_THAT(problems[0].message, ::testing::HasSubstr("'a' is taken"));
  EXPECT_EQ(problems[1].target, 1u);
  EXPECT_THAT(problems[1].message, ::testing::HasSubstr("begins inside targets[0]"));
  EXPECT_THROW(World(world_of({target_of(ball, "a"), target_of(close, "a")}), 1),
               std::invalid_argument);
}

// Property: time does not run backwards.
TEST(World, RefusesToSampleThePast) {
  World world(world_of({target_of(plain_ball(Vec2::Zero(), Vec2::Zero()))}), 1);
  world.sample(1.0);
  EXPECT_THROW(world.sample(0.5), std::invalid_argument);
}

// Property: a train may be one object, or as many as it has cars; its cars are bodies either way.
TEST(World, ShowsATrainAsOneObjectOrAsCars) {
  Train train = single_car(0.0, 10.0);
  train.cars = 3;
  World one(world_of({target_of(train, "express")}), 1);
  EXPECT_EQ(one.objects().size(), 1u);
  EXPECT_EQ(one.sample(0.0).bodies.size(), 3u);
  train.track_every_car = true;
  World many(world_of({target_of(train, "express")}), 1);
  ASSERT_EQ(many.objects().size(), 3u);
  EXPECT_EQ(many.objects()[1].name, "express car 2");
  EXPECT_NEAR(many.sample(0.0).objects[2].position.x(), -50.0, 1e-12);
}

}  // namespace
}  // namespace ghtrack

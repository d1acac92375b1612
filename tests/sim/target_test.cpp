#include "sim/target.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/world.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

ThrownBall ball_of(const Target& target) { return std::get<ThrownBall>(target.motion); }

// Property: a grid of repeated throws is spelled out copy by copy, numbered in that order.
TEST(Targets, AreCopiedOnAGridAndInTime) {
  Target machine = target_of(plain_ball(Vec2(1.0, 2.0), Vec2(30.0, 0.0)), "pitch");
  machine.disappears = 1.5;
  machine.grid = Grid{.columns = 2, .rows = 2, .spacing = Vec2(5.0, 7.0)};
  machine.repeat = Repeat{.count = 3, .every = 2.0, .shift = Vec2(0.0, 0.1)};
  const std::vector<Target> all = spell_out({machine});
  ASSERT_EQ(all.size(), 12u);
  EXPECT_EQ(all[0].name, "pitch 1");
  EXPECT_EQ(all[11].name, "pitch 12");
  EXPECT_EQ(ball_of(all[11]).position, Vec2(6.0, 9.0) + 2 * Vec2(0.0, 0.1));
  EXPECT_EQ(all[11].appears, 4.0);
  EXPECT_EQ(all[11].disappears, 5.5);
}

// Property: scattered copies fill their rectangle of places, speeds and times. The mean of n
// uniform numbers of (−1, 1) has a standard error of 1/√(3n).
TEST(Targets, AreScatteredUniformly) {
  Target swarm = target_of(plain_ball(Vec2(10.0, 50.0), Vec2(1.0, 0.0)), "swarm");
  constexpr int kCount = 2000;
  swarm.random = RandomCopies{
      .count = kCount, .area = Vec2(20.0, 8.0), .velocity = Vec2(3.0, 1.0), .within = 4.0};
  const std::vector<Target> all = spell_out({swarm});
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kCount));
  Vec2 place = Vec2::Zero();
  Vec2 speed = Vec2::Zero();
  double time = 0.0;
  for (const Target& target : all) {
    const Vec2 offset = (ball_of(target).position - Vec2(10.0, 50.0)).cwiseQuotient(Vec2(10, 4));
    const Vec2 change =
        (ball_of(target).initial_velocity() - Vec2(1.0, 0.0)).cwiseQuotient(Vec2(3.0, 1.0));
    ASSERT_LE(offset.cwiseAbs().maxCoeff(), 1.0);
    ASSERT_LE(change.cwiseAbs().maxCoeff(), 1.0);
    ASSERT_GE(target.appears, 0.0);
    ASSERT_LE(target.appears, 4.0);
    place += offset / kCount;
    speed += change / kCount;
    time += (target.appears / 2.0 - 1.0) / kCount;
  }
  const double bound = 4.5 / std::sqrt(3.0 * kCount);
  EXPECT_LT(place.cwiseAbs().maxCoeff(), bound);
  EXPECT_LT(speed.cwiseAbs().maxCoeff(), bound);
  EXPECT_LT(std::abs(time), bound);
}

// Property: a copy depends on its block's name and seed, not on how many others there are.
TEST(Targets, AreScatteredAlikeHoweverManyThereAre) {
  Target swarm = target_of(Balloon{}, "swarm");
  swarm.random = RandomCopies{.count = 10, .area = Vec2(500.0, 500.0)};
  const std::vector<Target> ten = spell_out({swarm});
  swarm.random->count = 20;
  const std::vector<Target> twenty = spell_out({target_of(Train{}), swarm});
  swarm.random->seed = 2;
  const std::vector<Target> others = spell_out({swarm});
  const auto place = [](const Target& t) { return std::get<Balloon>(t.motion).position; };
  for (std::size_t i = 0; i < ten.size(); ++i) {
    EXPECT_EQ(place(ten[i]), place(twenty[i + 1]));
    EXPECT_NE(place(ten[i]), place(others[i]));
  }
}

// Property: nameless copies are numbered with all others of their kind.
TEST(Targets, GetNamesThatAreNotTaken) {
  Target pair = target_of(ThrownBall{});
  pair.repeat = Repeat{.count = 2, .every = 1.0};
  std::vector<Target> listed{target_of(ThrownBall{}), pair, target_of(ThrownBall{}, "ball 3")};
  name_targets(listed);
  EXPECT_EQ(listed[0].name, "ball 1");
  EXPECT_EQ(listed[1].name, "");
  const std::vector<Target> all = spell_out(listed);
  EXPECT_EQ(all[1].name, "ball 2");
  EXPECT_EQ(all[2].name, "ball 4");
}

// Derived: a stone let go of at time t by a body in straight flight falls on a parabola from there,
// x = x_c(t) + v_c τ, y = y_c(t) + d − g τ²/2. The carrier's own appearance is between two steps.
TEST(Targets, FallFromAMovingCarrier) {
  Target carrier = target_of(single_car(0.0, 40.0), "carrier");
  std::get<Train>(carrier.motion).position = Vec2(0.0, 500.0);
  carrier.appears = 0.3333;
  Target stone = target_of(plain_ball(Vec2(0.0, -3.0), Vec2(0.0, 1.0)), "stone");
  stone.released_by = "carrier";
  stone.appears = 1.2345;
  World world(world_of({stone, carrier}), 1);
  EXPECT_EQ(world.sample(1.2).objects.size(), 1u);
  const TruthState now = world.sample(3.2345).objects.at(0);
  const double x = 40.0 * (3.2345 - 0.3333);
  const double y = 500.0 - 3.0 + 2.0 - 0.5 * kStandardGravity * 4.0;
  EXPECT_NEAR(now.position.x(), x, 1e-6);
  EXPECT_NEAR(now.position.y(), y, 1e-6);
  EXPECT_NEAR(now.velocity.x(), 40.0, 1e-9);
}

// Property: a released target can release another one, within one step of the physics too.
TEST(Targets, CanBeReleasedByReleasedOnes) {
  const auto released = [](const std::string& name, const std::string& by, double time) {
    Target target = target_of(plain_ball(Vec2(0.0, -1.0), Vec2::Zero()), name);
    target.released_by = by;
    target.appears = time;
    return target;
  };
  Target carrier = target_of(single_car(0.0, 10.0), "carrier");
  World world(world_of({released("third", "second", 0.503), released("second", "first", 0.502),
                        released("first", "carrier", 0.501), carrier}),
              1);
  const TruthSnapshot truth = world.sample(0.51);
  ASSERT_EQ(truth.objects.size(), 4u);
  for (const TruthState& state : truth.objects) EXPECT_NEAR(state.position.x(), 5.1, 1e-9);
  EXPECT_NEAR(truth.objects[0].position.y(), -3.0, 1e-3);
}

// Property: a scene of ten thousand targets is spelled out, checked and started.
TEST(Targets, CanBeTenThousand) {
  Target field = target_of(plain_ball(Vec2::Zero(), Vec2::Zero()), "field");
  field.grid = Grid{.columns = 100, .rows = 100, .spacing = Vec2(1.0, 1.0)};
  World world(world_of({field}), 1);
  EXPECT_EQ(world.sample(0.1).objects.size(), kMostTargets);
  field.grid->rows = 101;
  const std::vector<TargetProblem> problems = find_problems({field});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message, ::testing::HasSubstr("10100 targets"));
}

// Derived: a ball flies for `flight` s under gravity from hand to hand, is in the other hand then,
// and after flight + hold the next throw begins exactly in the hand.
TEST(Juggling, GoesFromHandToHand) {
  ThrownBall ball = plain_ball(Vec2(0.0, 1.2), Vec2::Zero());
  ball.velocity.reset();
  ball.juggle = Juggling{.to = Vec2(0.7, 1.3), .flight = 0.6, .hold = 0.3};
  World world(world_of({target_of(ball)}), 1);
  for (int cycle = 0; cycle < 20; ++cycle) {
    const bool back = cycle % 2 == 1;
    const Vec2 from = back ? ball.juggle->to : ball.position;
    const Vec2 to = back ? ball.position : ball.juggle->to;
    const double thrown = 0.9 * cycle;
    EXPECT_LT((state_at(world, thrown + 1e-9).position - from).norm(), 1e-6);
    EXPECT_NEAR(state_at(world, thrown + 0.3).position.y(),
                0.5 * (from.y() + to.y()) + kStandardGravity * 0.09 / 2.0, 1e-6);
    EXPECT_LT((state_at(world, thrown + 0.6 - 1e-9).position - to).norm(), 1e-6);
  }
}

// Property: a hand takes and throws smoothly: neither position nor velocity jumps, in air either.
TEST(Juggling, IsSmooth) {
  ThrownBall ball;
  ball.position = Vec2(0.0, 1.2);
  ball.juggle = Juggling{.to = Vec2(0.7, 1.3), .flight = 0.8, .hold = 0.25, .scoop = 0.2};
  World world(world_of({target_of(ball)}), 1);
  constexpr double kStep = 1.0 / 480.0;
  TruthState before = state_at(world, 0.0);
  for (int i = 1; i < 4000; ++i) {
    const TruthState now = state_at(world, i * kStep);
    ASSERT_LT((now.velocity - before.velocity).norm(), 200.0 * kStep);
    ASSERT_LT((now.position - before.position - kStep * before.velocity).norm(),
              100.0 * kStep * kStep);
    before = now;
  }
}

}  // namespace
}  // namespace ghtrack

#include "sim/regimes/thrown_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/portable_math.hpp"
#include "sim/world.hpp"
#include "tests/effort.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

ThrownBall preset(const std::string& type) {
  for (const ThrownBall& ball : ThrownBall::presets()) {
    if (ball.type == type) return ball;
  }
  throw std::invalid_argument(type);
}

/// Horizontal range down to y = 0.
double range_of(const ThrownBall& ball, double density = 1.2, double wind = 0.0) {
  WorldConfig config = world_of({target_of(ball)});
  config.environment.air.density = density;
  config.environment.wind.mean = Vec2(wind, 0.0);
  World world(config, 1);
  TruthState last = state_at(world, 0.0);
  for (int i = 1;; ++i) {
    const TruthState now = state_at(world, i / 240.0);
    if (now.position.y() < 0.0) {
      const double part = last.position.y() / (last.position.y() - now.position.y());
      return last.position.x() + part * (now.position.x() - last.position.x());
    }
    last = now;
  }
}

ThrownBall fly_ball() {  // 100 mph, 27.5°, 2000 rpm of backspin
  ThrownBall ball;
  ball.position = Vec2(0.0, 0.9);
  ball.speed = 44.704;
  ball.angle_deg = 27.5;
  ball.spin_rpm = 2000.0;
  return ball;
}

// T5. Derived: v_t = √(2 m g / ρ C_d A) within 1 % after 15 s, and y = −ln cosh(g t / v_t) / k on
// the way there. Without drag it would be 147 m/s.
TEST(ThrownBall, FallsAtItsTerminalSpeed) {
  for (const char* type : {"baseball", "tennis", "basketball", "table-tennis"}) {
    ThrownBall ball = preset(type);
    ball.position = Vec2(0.0, 1000.0);
    World world(world_of({target_of(ball)}), 1);
    const double k = 1.2 * ball.drag * portable::kPi * ball.radius * ball.radius / 2.0 / ball.mass;
    const double terminal = std::sqrt(kStandardGravity / k);
    const TruthState early = state_at(world, 3.0);
    EXPECT_NEAR(early.position.y(),
                1000.0 - std::log(std::cosh(3.0 * kStandardGravity / terminal)) / k, 1e-6);
    EXPECT_NEAR(-state_at(world, 15.0).velocity.y(), terminal, 0.01 * terminal) << type;
  }
}

// Derived: terminal speeds of Adair (baseball 40 to 43 m/s) and Cross (tennis 23 m/s).
TEST(ThrownBall, HasThePublishedTerminalSpeeds) {
  const auto terminal = [](const ThrownBall& ball) {
    return std::sqrt(2.0 * ball.mass * kStandardGravity /
                     (1.2 * ball.drag * portable::kPi * ball.radius * ball.radius));
  };
  EXPECT_NEAR(terminal(preset("baseball")), 40.1, 0.1);
  EXPECT_NEAR(terminal(preset("tennis")), 23.0, 0.1);
  EXPECT_NEAR(terminal(preset("basketball")), 20.4, 0.1);
}

// Derived: 413 ft for this fly ball with C_d 0.35 and Nathan's lift, found with an independent
// integrator; published rules (Nathan; Adair): +6 ft per 1000 ft of altitude, −30 ft in 10 mph of
// head wind. Box2D's limit on spin at 60 Hz takes 12 m away.
TEST(ThrownBall, FliesAsFarAsPublished) {
  constexpr double kFoot = 0.3048;
  const double range = range_of(fly_ball());
  EXPECT_NEAR(range / kFoot, 413.0, 1.0);
  const double higher = range_of(fly_ball(), 1.2 * 0.9636);  // 1000 ft higher
  EXPECT_NEAR((higher - range) / kFoot, 5.0, 1.0);
  const double against = range_of(fly_ball(), 1.2, -4.4704);
  EXPECT_NEAR((range - against) / kFoot, 35.0, 8.0);
}

// Property: backspin lifts a ball, topspin presses it down, whichever way it flies.
TEST(ThrownBall, IsLiftedByBackspin) {
  const auto height = [](double speed, double spin) {
    ThrownBall ball;
    ball.velocity = Vec2(speed, 0.0);
    ball.spin = spin;
    World world(world_of({target_of(ball)}), 1);
    return state_at(world, 0.5).position.y();
  };
  EXPECT_GT(height(40.0, 200.0), height(40.0, 0.0) + 0.1);
  EXPECT_LT(height(40.0, -200.0), height(40.0, 0.0) - 0.1);
  EXPECT_NEAR(height(-40.0, -200.0), height(40.0, 200.0), 1e-12);
}

// T8. Derived: a drop from h without drag rebounds to e² h, whatever the phase of the impact within
// a step. Box2D at 60 Hz: standard deviation 3.8 %, range −6 … +10 %.
TEST(ThrownBall, ReboundsToTheSameHeightAtEveryPhase) {
  for (int phase = 0; phase < 400; ++phase) {
    const double drop = 1.0 + phase / 200.0;  // 1 … 3 m
    ThrownBall ball = plain_ball(Vec2(0.0, drop + 0.0366), Vec2::Zero());
    ball.restitution = 0.745;
    WorldConfig config = world_of({target_of(ball)});
    config.physics.rate = 60.0;
    config.environment.ground = Ground{};
    World world(config, 1);
    const double fall = std::sqrt(2.0 * drop / kStandardGravity);
    const double top = state_at(world, fall * (1.0 + ball.restitution)).position.y() - ball.radius;
    ASSERT_NEAR(top / (0.745 * 0.745 * drop), 1.0, 1e-6) << drop;
  }
}

// Property: a perfectly elastic ball neither gains nor loses height. Box2D at 240 Hz: +30 % after
// 30 s.
TEST(ThrownBall, KeepsItsEnergyWhenItIsElastic) {
  ThrownBall ball = plain_ball(Vec2(0.0, 2.0), Vec2(1.0, 0.0));
  ball.restitution = 1.0;
  ball.friction = 0.0;
  WorldConfig config = world_of({target_of(ball)});
  config.environment.ground = Ground{};
  World world(config, 1);
  for (int i = 0; i <= 300; ++i) {
    const TruthState state = state_at(world, 0.1 * i);
    EXPECT_NEAR(kStandardGravity * state.position.y() + 0.5 * state.velocity.squaredNorm(),
                kStandardGravity * 2.0 + 0.5, 1e-8);
  }
}

// Property: a ball comes to rest on the ground, does not sink and does not tremble.
TEST(ThrownBall, ComesToRest) {
  ThrownBall ball = plain_ball(Vec2(0.0, 1.0), Vec2::Zero());
  WorldConfig config = world_of({target_of(ball)});
  config.environment.ground = Ground{};
  World world(config, 1);
  const TruthState state = state_at(world, 10.0);
  EXPECT_NEAR(state.position.y(), ball.radius, 1e-12);
  EXPECT_EQ(state.velocity.y(), 0.0);
  EXPECT_EQ(state.acceleration.y(), 0.0);
}

// Property: a rough ball that stands while its rim still creeps by half a micrometre a second
// stands for good: the last slip, which takes 20 ms to die out, does not push it.
TEST(ThrownBall, StandsThoughItsRimStillCreeps) {
  for (const double rim : {-5e-7, 2e-7, 5e-7}) {
    ThrownBall ball = plain_ball(Vec2(0.0, 0.1), Vec2::Zero());
    ball.radius = 0.1;
    ball.friction = 0.5;
    ball.spin = rim / ball.radius;
    WorldConfig config = world_of({target_of(ball)});
    config.environment.ground = Ground{};
    World world(config, 1);
    const TruthState state = state_at(world, 0.01);
    EXPECT_EQ(state.velocity, Vec2::Zero()) << rim;
    EXPECT_EQ(state.acceleration, Vec2::Zero()) << rim;
  }
}

// Derived: without friction x = v t whatever bounces are on the way; they last for
// √(2 h / g) (1 + e) / (1 − e). The last ones are shorter than a step: take the moment of departure
// for the next impact, and one ball in a hundred hangs in the air for ever.
TEST(ThrownBall, IsNotHeldUpByItsLastBounces) {
  for (const double rate : {20.0, 30.0}) {
    for (int i = 0; i < 200; ++i) {
      const double drop = 0.5 + 0.001 * i;
      const double e = 0.01 + 0.002 * i;
      ThrownBall ball = plain_ball(Vec2(0.0, 0.0366 + drop), Vec2(3.0, 0.0));
      ball.restitution = e;
      ball.friction = 0.0;
      WorldConfig config = world_of({target_of(ball)});
      config.physics.rate = rate;
      config.environment.ground = Ground{};
      World world(config, 1);
      const double bouncing = std::sqrt(2.0 * drop / kStandardGravity) * (1.0 + e) / (1.0 - e);
      const TruthState state = state_at(world, bouncing + 1.0);
      ASSERT_NEAR(state.position.x(), 3.0 * (bouncing + 1.0), 1e-9) << rate << ' ' << i;
      ASSERT_NEAR(state.position.y(), ball.radius, 1e-9) << rate << ' ' << i;
      ASSERT_EQ(state.velocity.y(), 0.0) << rate << ' ' << i;
    }
  }
}

// Derived: a solid ball (β = 2/5) that slides without spin rolls at 5/7 of its speed, after
// t = 2 v / (7 μ g).
TEST(ThrownBall, SlidesUntilItRolls) {
  ThrownBall ball = plain_ball(Vec2(0.0, 0.0366), Vec2(7.0, 0.0));
  ball.inertia = 0.4;
  ball.friction = 0.3;
  WorldConfig config = world_of({target_of(ball)});
  config.environment.ground = Ground{};
  World world(config, 1);
  const double sliding = 2.0 * 7.0 / (7.0 * 0.3 * kStandardGravity);
  EXPECT_NEAR(state_at(world, 0.5 * sliding).acceleration.x(), -0.3 * kStandardGravity, 1e-9);
  EXPECT_NEAR(state_at(world, 3.0 * sliding).velocity.x(), 5.0, 1e-3);
}

// Derived: a = g sin(α) / (1 + β) down a ramp, for a ball that rolls.
TEST(ThrownBall, RollsDownARamp) {
  ThrownBall ball = plain_ball(Vec2::Zero(), Vec2::Zero());
  ball.friction = 1.0;
  ball.restitution = 0.0;
  const Vec2 down = Vec2(4.0, -3.0) / 5.0;
  ball.position = 2.0 * down + Vec2(3.0, 4.0) / 5.0 * (ball.radius + 0.001);
  WorldConfig config = world_of({target_of(ball)});
  config.environment.walls = {Wall{Vec2::Zero(), 100.0 * down, {}, {}}};
  World world(config, 1);
  const Vec2 early = state_at(world, 1.0).velocity;
  const Vec2 late = state_at(world, 3.0).velocity;
  EXPECT_NEAR((late - early).dot(down), 2.0 * kStandardGravity * 0.6 / 1.4, 1e-3);
  EXPECT_NEAR(state_at(world, 3.0).position.dot(Vec2(3.0, 4.0) / 5.0), ball.radius, 1e-9);
}

// Property: no wall is thin enough, no ball fast enough.
TEST(ThrownBall, DoesNotPassThroughAWall) {
  for (int i = 0; i < 200; ++i) {
    ThrownBall ball = plain_ball(Vec2(-20.0 - 0.01 * i, 0.02 * i), Vec2(100.0, 0.0));
    WorldConfig config = world_of({target_of(ball)});
    config.environment.gravity = 0.0;
    config.physics.rate = 30.0;
    config.environment.walls = {Wall{Vec2(0.0, -5.0), Vec2(1.0, 5.0), {}, {}}};
    World world(config, 1);
    const TruthState state = state_at(world, 0.5);
    ASSERT_LT(state.velocity.x(), 0.0) << i;
    ASSERT_LT(state.position.x(), 0.5) << i;
  }
}

// Property: a ball in a corner, on the end of a wall or in a funnel loses its energy and stays out
// of everything solid; nothing takes for ever.
TEST(ThrownBall, SurvivesCornersAndEnds) {
  constexpr int kBalls = testing::samples(50);
  for (int i = 0; i < kBalls; ++i) {
    ThrownBall ball = plain_ball(Vec2(-1.0 + 2.0 * i / kBalls, 3.0), Vec2(0.3, 0.0));
    WorldConfig config = world_of({target_of(ball)});
    config.environment.ground = Ground{};
    config.environment.walls = {Wall{Vec2(-1.2, 2.0), Vec2(-0.05, 1.0), {}, {}},
                                Wall{Vec2(1.2, 2.0), Vec2(0.0, 1.0), {}, {}},
                                Wall{Vec2(-2.0, 0.0), Vec2(-2.0, 3.0), {}, {}},
                                Wall{Vec2(2.0, 0.0), Vec2(2.0, 3.0), {}, {}}};
    World world(config, 1);
    for (int k = 0; k <= 100; ++k) {
      const TruthState state = state_at(world, 0.1 * k);
      ASSERT_GT(state.position.y(), ball.radius - 1e-6) << i;
      ASSERT_LE(kStandardGravity * state.position.y() + 0.5 * state.velocity.squaredNorm(),
                kStandardGravity * 3.0 + 0.5 * 0.09 + 0.01)
          << i;
    }
  }
}

// Derived: it is the air that takes the spin: in air of half the density half as fast, in a vacuum
// not at all.
TEST(ThrownBall, LosesItsSpinToTheAir) {
  const auto left_of_spin = [](double density) {
    ThrownBall ball = preset("baseball");
    ball.velocity = Vec2(40.0, 0.0);
    ball.spin = 200.0;
    ball.drag = 0.0;
    ball.drag_crisis.reset();
    ball.lift = LiftModel::kNone;
    WorldConfig config = world_of({target_of(ball)});
    config.environment.gravity = 0.0;
    config.environment.air.density = density;
    World world(config, 1);
    return world.sample(10.0).bodies.at(0).spin / 200.0;
  };
  EXPECT_NEAR(std::log(left_of_spin(1.2)), -10.0 * 40.0 / (30.0 * 44.704), 1e-6);
  EXPECT_NEAR(std::log(left_of_spin(0.6)), -5.0 * 40.0 / (30.0 * 44.704), 1e-6);
  EXPECT_EQ(left_of_spin(0.0), 1.0);
}

// Property: a surface that names a restitution overrides the ball's own.
TEST(ThrownBall, TakesTheSurfacesRestitutionWhereItHasOne) {
  const auto rebound = [](const Ground& ground) {
    ThrownBall ball = plain_ball(Vec2(0.0, 1.0366), Vec2::Zero());
    ball.restitution = 0.5;
    WorldConfig config = world_of({target_of(ball)});
    config.environment.ground = ground;
    World world(config, 1);
    return state_at(world, 0.5).velocity.y();
  };
  const double impact = std::sqrt(2.0 * kStandardGravity);
  const double rest = 0.5 - impact / kStandardGravity;
  EXPECT_NEAR(rebound(Ground{}), 0.5 * impact - kStandardGravity * rest, 1e-6);
  EXPECT_NEAR(rebound(Ground{0.0, 0.9, {}}), 0.9 * impact - kStandardGravity * rest, 1e-6);
}

}  // namespace
}  // namespace ghtrack

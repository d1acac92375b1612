#include "sim/regimes/route.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sim/portable_math.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

constexpr double kPi = portable::kPi;

RouteLeg leg(RouteCourse course, std::optional<double> speed = {}) {
  RouteLeg result;
  result.course = course;
  result.speed = speed;
  return result;
}

Route driving(double speed, std::vector<RouteLeg> legs) {
  Route route;
  route.speed = speed;
  route.legs = std::move(legs);
  return route;
}

TruthState state_of(const Route& route, double time) {
  World world(world_of({target_of(route)}), 1);
  return state_at(world, time);
}

// Derived: the turn around a corner touches both legs r tan(φ/2) before and after it and is an arc
// of r φ; on it the acceleration is v²/r, towards its centre.
TEST(Route, RoundsACornerByAnArc) {
  Route route = driving(10.0, {leg(GoTo{Vec2(100.0, 0.0)}), leg(GoTo{Vec2(100.0, 100.0)})});
  route.turn_radius = 10.0;
  const double on_arc = (90.0 + 2.5 * kPi) / 10.0;
  const double slant = std::sqrt(0.5);
  const TruthState middle = state_of(route, on_arc);
  EXPECT_LT((middle.position - Vec2(90.0 + 10.0 * slant, 10.0 - 10.0 * slant)).norm(), 1e-12);
  EXPECT_LT((middle.velocity - Vec2(10.0 * slant, 10.0 * slant)).norm(), 1e-12);
  EXPECT_LT((middle.acceleration - Vec2(-10.0 * slant, 10.0 * slant)).norm(), 1e-12);
  const TruthState end = state_of(route, (180.0 + 5.0 * kPi) / 10.0);
  EXPECT_LT((end.position - Vec2(100.0, 100.0)).norm(), 1e-12);
  const TruthState beyond = state_of(route, (180.0 + 5.0 * kPi) / 10.0 + 3.0);
  EXPECT_LT((beyond.position - Vec2(100.0, 130.0)).norm(), 1e-12);
}

// Derived: speed changes take |v² − u²|/2a, before a slower leg and after it.
TEST(Route, SlowsDownBeforeASlowLegAndHastensAfterIt) {
  Route route = driving(20.0, {leg(Straight{200.0}), leg(Straight{50.0}, 10.0),
                               leg(Straight{500.0}, 30.0), leg(Wait{5.0})});
  route.acceleration = 2.0;
  // 20 → 10 m/s in 5 s over 75 m at the end of the first leg, 10 → 30 in 10 s over 200 m at the
  // beginning of the third, 30 → 0 in 15 s over 225 m at its end.
  EXPECT_NEAR(state_of(route, 6.25).velocity.x(), 20.0, 1e-12);
  EXPECT_NEAR(state_of(route, 8.75).velocity.x(), 15.0, 1e-12);
  EXPECT_NEAR(state_of(route, 8.75).acceleration.x(), -2.0, 1e-12);
  const double slow = 6.25 + 5.0;
  EXPECT_NEAR(state_of(route, slow + 2.5).position.x(), 225.0, 1e-9);
  EXPECT_NEAR(state_of(route, slow + 2.5).velocity.x(), 10.0, 1e-12);
  const double fast = slow + 5.0 + 10.0;
  EXPECT_NEAR(state_of(route, fast + 1.0).position.x(), 250.0 + 200.0 + 30.0, 1e-9);
  const double standing = fast + 75.0 / 30.0 + 15.0;
  for (const double since : {0.001, 4.9, 50.0}) {
    EXPECT_NEAR(state_of(route, standing + since).position.x(), 750.0, 1e-9);
    EXPECT_EQ(state_of(route, standing + since).velocity, Vec2::Zero());
  }
}

// Derived: a turn at the rate ω and speed v has the radius v/ω, one at the lateral acceleration a
// the radius v²/a; a full turn leads back to where it began, after 2π/ω.
TEST(Route, TurnsAtARate) {
  for (const bool by_rate : {true, false}) {
    Turn turn{.angle_deg = 360.0};
    if (by_rate) turn.rate_deg = 3.0;
    if (!by_rate) turn.acceleration = 120.0 * 3.0 * kPi / 180.0;
    const Route route = driving(120.0, {leg(HoldCourse{10.0}), leg(turn), leg(HoldCourse{1.0})});
    const double radius = 120.0 / (3.0 * kPi / 180.0);
    EXPECT_LT((state_of(route, 10.0 + 60.0).position - Vec2(1200.0, 2.0 * radius)).norm(), 1e-8);
    EXPECT_LT((state_of(route, 10.0 + 120.0).position - Vec2(1200.0, 0.0)).norm(), 1e-8);
    EXPECT_NEAR(state_of(route, 40.0).acceleration.norm(), 120.0 * 120.0 / radius, 1e-9);
  }
}

std::string flaw_of(const Route& route) {
  const auto flaws = route.flaws();
  return flaws.empty() ? "" : flaws[0].key + ": " + flaws[0].message;
}

// Property: what cannot be driven is said, and where.
TEST(Route, SaysWhatCannotBeDriven) {
  Route corner = driving(10.0, {leg(GoTo{Vec2(10.0, 0.0)}), leg(GoTo{Vec2(10.0, 40.0)})});
  corner.turn_radius = 5.0;
  EXPECT_EQ(flaw_of(corner), "");
  corner.legs[0].turn_radius = 12.0;
  EXPECT_EQ(flaw_of(corner),
            "legs[0].turn_radius: a turn of 12.0 m into the next leg takes 12.0 m "
            "of both; there are 10.0");
  Route back = driving(1.0, {leg(GoTo{Vec2(10.0, 0.0)}), leg(GoTo{Vec2(0.0, 0.0)})});
  EXPECT_EQ(flaw_of(back).substr(0, 20), "legs[0].turn_radius:");
  back.legs[0].turn_radius = 0.0;
  EXPECT_EQ(flaw_of(back), "");
  Route braking = driving(10.0, {leg(Straight{20.0}), leg(Wait{1.0})});
  EXPECT_EQ(flaw_of(braking),
            "legs[0]: is too short to change from 10.0 to 10.0 and to 0.0 m/s: "
            "50.0 m are needed, 20.0 m are there");
  EXPECT_EQ(flaw_of(driving(0.0, {leg(Straight{20.0})})).substr(0, 14), "legs[0].speed:");
  EXPECT_EQ(flaw_of(driving(0.0, {leg(Wait{5.0}), leg(Straight{20.0}, 2.0)})), "");
  EXPECT_EQ(flaw_of(driving(5.0, {leg(Turn{.radius = 9.0}), leg(Wait{5.0})})).substr(0, 8),
            "legs[1]:");
  EXPECT_EQ(flaw_of(driving(5.0, {leg(GoTo{Vec2::Zero()})})).substr(0, 11), "legs[0].to:");
}

Route straying(
    std::variant<NoProcessNoise, WhiteAcceleration, SingerAcceleration, NoisyTurn> model) {
  Route route = driving(30.0, {});
  route.process_noise.model = model;
  return route;
}

/// Second moments over many runs, of a route along x.
struct Moments {
  double xx = 0.0, xv = 0.0, vv = 0.0, aa = 0.0, headings = 0.0, speeds = 0.0;
};

constexpr int kRuns = 4000;

Moments moments_of(const Route& route, double time) {
  const Environment environment({}, 1);
  Moments sum;
  for (int run = 0; run < kRuns; ++run) {
    const RouteModel model(route, {static_cast<std::uint64_t>(run), 7});
    RouteModel::State state = model.start(environment, 0.0);
    model.advance(state, environment, 0.0, time, nullptr);
    const PlanarMotion now = model.kinematics(state, environment, time, 0);
    const double x = now.position.x() - route.speed * time;
    const double v = now.velocity.x() - route.speed;
    const double heading = std::atan2(now.velocity.y(), now.velocity.x());
    const double hurry = now.velocity.norm() - route.speed;
    sum.xx += x * x / kRuns;
    sum.xv += x * v / kRuns;
    sum.vv += v * v / kRuns;
    sum.aa += now.acceleration.x() * now.acceleration.x() / kRuns;
    sum.headings += heading * heading / kRuns;
    sum.speeds += hurry * hurry / kRuns;
  }
  return sum;
}

/// Five standard errors of a normal variable's sample variance, as a fraction of it.
const double kMomentBound = 5.0 * std::sqrt(2.0 / kRuns);

// Derived: white acceleration of density q leaves q [T³/3 T²/2; T²/2 T] after the time T
// (Bar-Shalom, Li & Kirubarajan 2001, equation 6.2.2-12).
TEST(ProcessNoise, HasTheCovarianceOfNearlyConstantVelocity) {
  constexpr double kTime = 1.5;
  const Moments moments = moments_of(straying(WhiteAcceleration{2.0}), kTime);
  EXPECT_NEAR(moments.vv / (2.0 * kTime), 1.0, kMomentBound);
  EXPECT_NEAR(moments.xx / (2.0 * kTime * kTime * kTime / 3.0), 1.0, kMomentBound);
  EXPECT_NEAR(moments.xv / (2.0 * kTime * kTime / 2.0), 1.0, kMomentBound);
}

// Derived: Singer's acceleration is stationary, and the velocity that it leaves has the variance
// 2 σ² T² (t/T − 1 + e^(−t/T)) (the integral of the Ornstein–Uhlenbeck process).
TEST(ProcessNoise, HasTheCovarianceOfSingersModel) {
  constexpr double kTime = 3.0;
  const Moments moments = moments_of(straying(SingerAcceleration{1.5, 2.0}), kTime);
  const double ratio = kTime / 2.0;
  const double velocity = 2.0 * 1.5 * 1.5 * 4.0 * (ratio - 1.0 + std::exp(-ratio));
  EXPECT_NEAR(moments.aa / (1.5 * 1.5), 1.0, kMomentBound);
  EXPECT_NEAR(moments.vv / velocity, 1.0, kMomentBound);
}

// Derived: a turn rate that is a random walk of density q leaves q T³/3 to the heading; a speed
// that is one leaves q T.
TEST(ProcessNoise, HasTheCovarianceOfANoisyTurn) {
  constexpr double kTime = 2.0;
  const Moments moments = moments_of(straying(NoisyTurn{2.0, 0.5}), kTime);
  const double density = std::pow(2.0 * kPi / 180.0, 2);
  EXPECT_NEAR(moments.headings / (density * kTime * kTime * kTime / 3.0), 1.0, kMomentBound);
  EXPECT_NEAR(moments.speeds / (0.25 * kTime), 1.0, kMomentBound);
}

// Property: position, velocity and acceleration belong together, whatever the noise, also where the
// route bends.
TEST(ProcessNoise, KeepsDerivativesTogether) {
  const std::vector<Route> all{straying(NoProcessNoise{}), straying(WhiteAcceleration{0.1}),
                               straying(SingerAcceleration{2.0, 1.0}),
                               straying(NoisyTurn{5.0, 1.0})};
  for (Route route : all) {
    route.legs = {leg(HoldCourse{0.8}), leg(Turn{.angle_deg = 90.0, .radius = 20.0})};
    World world(world_of({target_of(route)}), 3);
    constexpr double kHalf = 1e-4;
    for (const double time : {0.505, 1.205, 1.905}) {
      const TruthState before = state_at(world, time - kHalf);
      const TruthState now = state_at(world, time);
      const TruthState after = state_at(world, time + kHalf);
      EXPECT_LT(((after.position - before.position) / (2.0 * kHalf) - now.velocity).norm(), 2e-5);
      EXPECT_LT(((after.velocity - before.velocity) / (2.0 * kHalf) - now.acceleration).norm(),
                2e-3);
    }
  }
}

// Property: the way depends on the seed and the target's name, not on the instants of sampling, on
// the rate of the physics or on other targets; without noise, on none of these.
TEST(ProcessNoise, DependsOnSeedAndNameAlone) {
  for (const Route& route :
       {straying(WhiteAcceleration{1.0}), straying(SingerAcceleration{2.0, 1.0})}) {
    WorldConfig alone = world_of({target_of(route, "one")});
    World often(alone, 5);
    for (int i = 0; i < 200; ++i) often.sample(0.0173 * i);
    const Vec2 place = state_at(often, 4.0).position;
    WorldConfig crowd = world_of({target_of(route, "other"), target_of(route, "one")});
    crowd.physics.rate = 50.0;
    World seldom(crowd, 5);
    const TruthSnapshot truth = seldom.sample(4.0);
    EXPECT_EQ(truth.objects[1].position, place);
    EXPECT_NE(truth.objects[0].position, place);
    World again(alone, 6);
    EXPECT_NE(state_at(again, 4.0).position, place);
  }
}

}  // namespace
}  // namespace ghtrack

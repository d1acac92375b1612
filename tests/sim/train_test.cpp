#include "sim/regimes/train.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"
#include "sim/world.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

Train stock(const std::string& name) {
  for (const Train& train : Train::presets()) {
    if (train.stock == name) return train;
  }
  throw std::invalid_argument(name);
}

// T10. Derived: T = ∫ M dv / R(v), s = ∫ M v dv / R(v), by Simpson's rule: 898.34 s and 10301.4 m
// for the EMU from 30 m/s. A constant force that goes on acting at rest drives it 2161 m backwards
// instead.
TEST(Train, CoastsToAStandWhereTheIntegralSaysAndStays) {
  Train train = stock("RB425");
  train.speed = 30.0;
  train.drive = {phase_at(0.0, Coast{})};
  double time = 0.0;
  double distance = 0.0;
  constexpr int kParts = 10000;
  for (int i = 0; i <= kParts; ++i) {
    const double v = 30.0 * i / kParts;
    const double weight =
        (i == 0 || i == kParts ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0)) * 30.0 / kParts / 3.0;
    const double slowness = train.mass * train.rotating_mass /
                            (train.davis_a + train.davis_b * v + train.davis_c * v * v);
    time += weight * slowness;
    distance += weight * slowness * v;
  }
  EXPECT_NEAR(time, 898.34, 0.01);
  EXPECT_NEAR(distance, 10301.4, 0.1);
  World world(world_of({target_of(train)}), 1);
  EXPECT_GT(state_at(world, time - 0.1).velocity.x(), 0.0);
  EXPECT_EQ(state_at(world, time + 0.1).velocity.x(), 0.0);
  EXPECT_NEAR(state_at(world, 1400.0).position.x(), distance, 0.01);
}

// Derived: Davis coefficients: deceleration of the coasting train at a speed, from SUMO's tables
// (MSCFModel_Rail).
TEST(Train, CoastsWithThePublishedDecelerations) {
  const auto deceleration = [](const std::string& name, double speed) {
    Train train = stock(name);
    train.speed = speed;
    train.drive = {phase_at(0.0, Coast{})};
    World world(world_of({target_of(train)}), 1);
    return -state_at(world, 0.0).acceleration.x();
  };
  EXPECT_NEAR(deceleration("ICE3", 83.3), 0.164, 0.001);
  EXPECT_NEAR(deceleration("ICE1", 69.4), 0.128, 0.001);
  EXPECT_NEAR(deceleration("RB425", 44.4), 0.130, 0.001);
  EXPECT_NEAR(deceleration("RB628", 33.3), 0.123, 0.001);
  EXPECT_NEAR(deceleration("RE", 44.4), 0.086, 0.001);
  EXPECT_NEAR(deceleration("freight", 15.0), 0.0157, 0.0005);
}

// T11. Property: a braked train stops and stays; the speed is never negative. A brake that is a
// force ends at −25 m/s.
TEST(Train, StopsAndRemainsStopped) {
  for (const BrakeKind brake : {BrakeKind::kService, BrakeKind::kEmergency}) {
    Train train = single_car(0.0, 40.0, {phase_at(2.0, Brake{brake})});
    World world(world_of({target_of(train)}), 1);
    for (int i = 0; i < 2000; ++i) {
      EXPECT_GE(state_at(world, 0.1 * i).velocity.x(), 0.0);
    }
    EXPECT_EQ(state_at(world, 200.0).velocity.x(), 0.0);
    EXPECT_EQ(state_at(world, 200.0).acceleration.x(), 0.0);
  }
}

// Property: on a slope a train that has come to a stand rolls back, unless its brakes hold; they
// give way to the driver.
TEST(Train, HoldsOnASlopeIfItsBrakesDo) {
  for (const bool holds : {false, true}) {
    Train train = single_car(0.0, 8.0, {phase_at(0.0, Coast{}), phase_at(200.0, Accelerate{0.1})});
    train.grades = {Grade{-1e4, 1e4, 0.02}};
    train.holding_brake = holds;
    World world(world_of({target_of(train)}), 1);
    const double stopped = state_at(world, 100.0).position.x();
    const TruthState later = state_at(world, 199.0);
    if (!holds) {
      EXPECT_LT(later.position.x(), stopped - 100.0);
      continue;
    }
    EXPECT_EQ(later.position.x(), stopped);
    EXPECT_EQ(later.velocity.x(), 0.0);
    EXPECT_NEAR(state_at(world, 220.0).velocity.x(), 2.0, 1e-6);
  }
}

// T12. Derived: v = a t. Box2D's sleeping keeps a train for ever that starts at less than 0.02
// m/s².
TEST(Train, StartsGentlyFromAHalt) {
  Train train = single_car(0.0, 0.0, {phase_at(2.0, Accelerate{0.005})});
  World world(world_of({target_of(train)}), 1);
  EXPECT_EQ(state_at(world, 2.0).velocity.x(), 0.0);
  EXPECT_NEAR(state_at(world, 12.0).velocity.x(), 0.05, 1e-9);
}

// Property: negative acceleration slows down to a halt; nothing reverses by itself.
TEST(Train, HaltsUnderNegativeAcceleration) {
  Train train = single_car(0.0, 2.0, {phase_at(1.0, Accelerate{-0.5})});
  World world(world_of({target_of(train)}), 1);
  EXPECT_NEAR(state_at(world, 3.0).velocity.x(), 1.0, 1e-9);
  EXPECT_EQ(state_at(world, 10.0).velocity.x(), 0.0);
  EXPECT_NEAR(state_at(world, 10.0).position.x(), 2.0 + 4.0, 1e-6);
}

// Property: traction backwards reverses a train; a driver can keep a speed backwards.
TEST(Train, Reverses) {
  Train train =
      single_car(0.0, 0.0, {phase_at(1.0, Traction{-0.5}), phase_at(20.0, TargetSpeed{-5.0})});
  World world(world_of({target_of(train)}), 1);
  EXPECT_LT(state_at(world, 20.0).velocity.x(), -5.0);
  EXPECT_NEAR(state_at(world, 80.0).velocity.x(), -5.0, 1e-6);
}

// Derived: at rest on a slope the brakes hold; released, a = g i − A/m once it outweighs the
// constant part of the resistance.
TEST(Train, RollsDownASlopeOnlyWhenReleased) {
  Train train = single_car(0.0, 0.0, {phase_at(5.0, Coast{})});
  train.grades = {Grade{-1000.0, 1000.0, -0.01}};
  World world(world_of({target_of(train)}), 1);
  EXPECT_EQ(state_at(world, 5.0).velocity.x(), 0.0);
  const double wanted =
      (kStandardGravity * 0.01 - train.davis_a / train.mass) / train.rotating_mass;
  EXPECT_NEAR(state_at(world, 5.01).acceleration.x(), wanted, 1e-4);
  train.grades = {Grade{-1000.0, 1000.0, -0.001}};  // weaker than A
  World flat(world_of({target_of(train)}), 1);
  EXPECT_EQ(state_at(flat, 60.0).velocity.x(), 0.0);
}

// Derived: μ = 7.5/(V + 44) + 0.161 with V in km/h (Curtius & Kniffler): 0.331 at a stand. Wet
// rails limit the start of a train, dry ones its motors.
TEST(Train, StartsAsFastAsAdhesionPermits) {
  Train train = single_car(0.0, 0.0, {phase_at(0.0, Traction{1.0})});
  train.adhesion = 0.3;
  World wet(world_of({target_of(train)}), 1);
  const double grip = 0.3 * (7.5 / 44.0 + 0.161) * train.adhesive_mass * kStandardGravity;
  EXPECT_NEAR(state_at(wet, 0.0).acceleration.x(),
              (grip - train.davis_a) / (train.mass * train.rotating_mass), 1e-9);
}

// Property: the driver approaches a speed without overshoot and keeps it.
TEST(Train, KeepsATargetSpeed) {
  Train train =
      single_car(0.0, 10.0, {phase_at(1.0, TargetSpeed{25.0}), phase_at(120.0, TargetSpeed{15.0})});
  World world(world_of({target_of(train)}), 1);
  for (int i = 0; i < 120; ++i) EXPECT_LE(state_at(world, i).velocity.x(), 25.0 + 1e-9);
  EXPECT_NEAR(state_at(world, 120.0).velocity.x(), 25.0, 1e-3);
  EXPECT_NEAR(state_at(world, 240.0).velocity.x(), 15.0, 1e-3);
}

// Property: a train stops at the station, waits and leaves at the next phase.
TEST(Train, StopsAtAStationAndLeaves) {
  Train train = single_car(
      0.0, 30.0, {phase_at_position(100.0, StationStop{1500.0}), phase_at(150.0, Accelerate{0.3})});
  World world(world_of({target_of(train)}), 1);
  double hardest = 0.0;
  for (int i = 0; i < 1490; ++i) {
    hardest = std::max(hardest, -state_at(world, 0.1 * i).acceleration.x());
  }
  EXPECT_LE(hardest, train.service_brake + 0.03);
  const TruthState waiting = state_at(world, 149.0);
  EXPECT_NEAR(waiting.position.x(), 1500.0, 0.05);
  EXPECT_EQ(waiting.velocity.x(), 0.0);
  EXPECT_NEAR(state_at(world, 160.0).velocity.x(), 3.0, 1e-6);
}

// Derived: a phase at a position begins there: v² = v0² + 2 a (s − s0).
TEST(Train, BeginsAPhaseAtItsPlace) {
  Train train = single_car(0.0, 20.0, {phase_at_position(500.0, Accelerate{-0.4})});
  World world(world_of({target_of(train)}), 1);
  const TruthState state = state_at(world, 40.0);
  EXPECT_NEAR(state.velocity.x(), std::sqrt(400.0 - 0.8 * (state.position.x() - 500.0)), 1e-6);
}

// Property: run-out: with slack the cars start one after the other, and the gaps stay within the
// play and the springs' stroke; in the end all have one speed.
TEST(Train, TakesUpSlackCarByCar) {
  Train train = stock("freight");
  train.cars = 10;
  train.couplers = Couplers{3e7, 1e6, 0.025};
  train.track_every_car = true;
  train.drive = {phase_at(0.0, Accelerate{0.1})};
  World world(world_of({target_of(train)}), 1);
  std::vector<double> started(10, -1.0);
  for (int i = 0; i <= 1200; ++i) {
    const TruthSnapshot truth = world.sample(0.05 * i);
    for (std::size_t k = 0; k < 10; ++k) {
      if (started[k] < 0.0 && truth.objects[k].velocity.x() > 0.01) started[k] = 0.05 * i;
      if (k == 0) continue;
      const double gap = truth.objects[k - 1].position.x() - truth.objects[k].position.x();
      EXPECT_NEAR(gap, train.car_length, 0.04);
    }
  }
  EXPECT_TRUE(std::is_sorted(started.begin(), started.end()));
  EXPECT_GT(started[9], started[0] + 1.0);
  const TruthSnapshot truth = world.sample(60.0);
  EXPECT_NEAR(truth.objects[9].velocity.x(), truth.objects[0].velocity.x(), 0.05);
}

// Property: a braked sprung train comes to rest as a whole and stays.
TEST(Train, StopsWithSpringsBetweenItsCars) {
  Train train = stock("freight");
  train.cars = 6;
  train.speed = 10.0;
  train.couplers = Couplers{2e7, 5e5, 0.05};
  train.drive = {phase_at(1.0, Brake{BrakeKind::kEmergency})};
  train.track_every_car = true;
  World world(world_of({target_of(train)}), 1);
  const TruthSnapshot stopped = world.sample(60.0);
  const TruthSnapshot later = world.sample(70.0);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(later.objects[i].velocity.x(), 0.0);
    EXPECT_EQ(later.objects[i].position, stopped.objects[i].position);
  }
}

// T14. Derived: nothing that a train does exceeds its brakes and tractive effort along, v²/R across
// the track. Chords of 20 m on R = 300 m look like 60 m/s².
TEST(Train, NeverAcceleratesMoreThanItsTrackDemands) {
  Train train = single_car(0.0, 15.0, {phase_at(20.0, Accelerate{0.4}), phase_at(40.0, Brake{})});
  train.track = {Straight{100.0}, Curve{300.0, 90.0, {}, 60.0}, Curve{-250.0, 45.0, {}, 50.0}};
  World world(seen_from_above({target_of(train)}), 1);
  constexpr double kRate = 60.0;
  TruthState before = state_at(world, 0.0);
  for (int i = 1; i < 80 * 60; ++i) {
    const TruthState now = state_at(world, i / kRate);
    const double acceleration = (now.velocity - before.velocity).norm() * kRate;
    const double speed = now.velocity.norm();
    EXPECT_LE(acceleration, 1.05 * (1.0 + speed * speed / 250.0)) << i / kRate;
    before = now;
  }
}

// Derived: a track that is drawn uphill in a side view is a grade: without resistance a = −g sin α,
// and on a vertical loop v²/2 + g y stays. A flat track seen from above weighs nothing.
TEST(Train, IsHeavyOnATrackDrawnUphill) {
  for (const double slope : {5.0, -5.0, 20.0, 180.0}) {
    Train train = free_cars(1, 50e3, 0.0, 30.0, {phase_at(0.0, Coast{})});
    train.heading_deg = slope;
    World world(world_of({target_of(train)}), 1);
    const double angle = slope * portable::kPi / 180.0;
    const double expected = slope == 180.0 ? 0.0 : -kStandardGravity * std::sin(angle);
    const TruthState state = state_at(world, 2.0);
    EXPECT_NEAR(state.acceleration.dot(direction(angle)), expected, 1e-12) << slope;
    EXPECT_NEAR(state.velocity.dot(direction(angle)), 30.0 + 2.0 * expected, 1e-9) << slope;
  }
  Train train = free_cars(1, 50e3, 0.0, 70.0, {phase_at(0.0, Coast{})});
  train.track = {Straight{100.0}, Curve{100.0, 360.0, {}, 0.0}, Straight{1000.0}};
  World loop(world_of({target_of(train)}), 1);
  WorldConfig above = world_of({target_of(train)});
  above.environment.gravity = 0.0;
  World flat(above, 1);
  for (int i = 1; i <= 100; ++i) {
    const TruthState state = state_at(loop, 0.2 * i);
    EXPECT_NEAR(0.5 * state.velocity.squaredNorm() + kStandardGravity * state.position.y(), 2450.0,
                1e-3);
    EXPECT_NEAR(state_at(flat, 0.2 * i).velocity.norm(), 70.0, 1e-9);
  }
}

// Property: a limit is kept in both directions by who can brake in time, and one that is not is
// said, once.
TEST(Train, SaysThatALimitWasExceeded) {
  Train train = free_cars(1, 50e3, 1000.0, 0.0, {phase_at(0.0, TargetSpeed{-50.0})});
  train.service_brake = 0.5;
  train.max_power = 1e9;
  train.speed_limits = {{0.0, 500.0, 20.0}};
  World backwards(world_of({target_of(train)}), 1);
  for (int i = 1; i <= 120; ++i) {
    const TruthState state = state_at(backwards, i);
    if (state.position.x() > 500.0 || state.position.x() < 0.0) continue;
    EXPECT_GT(state.velocity.x(), -20.3) << i;
  }
  EXPECT_TRUE(backwards.events().empty());
  train.start = 0.0;
  train.speed = 60.0;
  train.drive = {phase_at(0.0, TargetSpeed{60.0})};
  train.speed_limits = {{300.0, 2000.0, 20.0}};
  World late(world_of({target_of(train)}), 1);
  state_at(late, 120.0);
  ASSERT_EQ(late.events().size(), 1u);
  EXPECT_EQ(late.events()[0].kind, EventKind::kOverspeed);
  EXPECT_NEAR(late.events()[0].position.x(), 300.0, 2.0);
}

// Property: who stalls on the way to a stop holds his train.
TEST(Train, HoldsWhereItStalls) {
  Train train = stock("freight");
  train.speed = 10.0;
  train.grades = {{100.0, 1e5, 0.04}};
  train.drive = {phase_at(0.0, StationStop{4000.0})};
  World world(world_of({target_of(train)}), 1);
  const TruthState stalled = state_at(world, 250.0);
  EXPECT_EQ(stalled.velocity, Vec2(0.0, 0.0));
  EXPECT_EQ(state_at(world, 300.0).position, stalled.position);
}

// T13. Property: the speed on a closed loop does not suffer from its curvature (Box2D with a
// projected velocity loses 3.3 m along the track in a minute), and the train comes back to its
// place.
TEST(Train, ComesBackOnALoop) {
  Train train = single_car(0.0, 20.0);
  train.track = {Straight{200.0}, Curve{100.0, 180.0, {}, 0.0}, Straight{200.0},
                 Curve{100.0, 180.0, {}, 0.0}};
  World world(world_of({target_of(train)}), 1);
  const double lap = (400.0 + 2.0 * portable::kPi * 100.0) / 20.0;
  EXPECT_NEAR(state_at(world, lap).position.norm(), 0.0, 1e-9);
  EXPECT_NEAR(state_at(world, lap).velocity.norm(), 20.0, 1e-9);
}

}  // namespace
}  // namespace ghtrack

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/portable_math.hpp"
#include "tests/sim/scenario.hpp"

// Trains that meet others on their track, and brakes that act car by car.

namespace ghtrack {
namespace {

/// Sprung cars that nothing holds back, each an object of its own.
Train free_train(int cars, double mass, double speed, std::vector<DrivePhase> drive = {}) {
  Train train = free_cars(cars, mass, 0.0, speed, std::move(drive));
  train.track_every_car = true;
  train.couplers = Couplers{1e7, 0.0, 0.0};
  return train;
}

// Derived: cars that couple go on together with m₁ v / (m₁ + m₂), and their springs have taken
// ½ v² m₁ m₂ / (m₁ + m₂) once they are at rest; they touch after gap / v.
TEST(Shunting, CouplesByMomentum) {
  Train train = free_train(2, 100e3, 2.0);
  train.couplers->damping = 2e5;
  train.ahead = {CarsAhead{30.0, 3, 20e3, 0.0, true}};
  WorldConfig config = world_of({target_of(train)});
  config.record.events = true;
  World world(config, 1);
  const std::vector<double> masses{50e3, 50e3, 20e3, 20e3, 20e3};
  const double begun = kinetic_energy(world.sample(0.0), masses);
  const TruthSnapshot truth = world.sample(40.0);
  ASSERT_EQ(truth.objects.size(), 5u);
  const double common = 100.0 * 2.0 / 160.0;
  for (const TruthState& car : truth.objects) EXPECT_NEAR(car.velocity.x(), common, 1e-4);
  EXPECT_NEAR(begun - kinetic_energy(truth, masses), 0.5 * 4.0 * 100e3 * 60e3 / 160e3, 50.0);
  ASSERT_EQ(world.events().size(), 1u);
  EXPECT_EQ(world.events()[0].kind, EventKind::kCoupling);
  EXPECT_NEAR(world.events()[0].time, 10.0, 1e-6);
  EXPECT_EQ(world.events()[0].object, 0);
  EXPECT_EQ(world.events()[0].other, 4);  // the last of the cars ahead
  EXPECT_LT((world.events()[0].impulse - Vec2(-100e3 * (2.0 - common), 0.0)).norm(), 1e-2);
  // The train's cars stay behind, the others in their order ahead.
  EXPECT_NEAR(truth.objects[0].position.x() - truth.objects[1].position.x(), 10.0, 1e-3);
  EXPECT_NEAR(truth.objects[4].position.x() - truth.objects[0].position.x(), 10.0, 1e-3);
  EXPECT_NEAR(truth.objects[2].position.x() - truth.objects[4].position.x(), 20.0, 1e-3);
}

// Derived: undamped couplings with play keep momentum and the energy of motion and springs, whether
// the cars that they catch are of the train or another target: the springs bear from the end of the
// play on.
TEST(Shunting, KeepsTheEnergyOfCouplingsWithPlay) {
  const double stiffness = 1e7;
  for (const double slack : {0.005, 0.02}) {
    Train train = free_train(3, 75e3, 2.0);
    train.couplers = Couplers{stiffness, 0.0, slack};
    Train alone = train;
    train.ahead = {CarsAhead{22.0, 2, 20e3, 0.0, true}};
    Train other = free_train(2, 40e3, 0.0);
    other.couplers = train.couplers;
    other.start = 32.0;
    for (const std::vector<Target>& targets :
         {std::vector{target_of(train)}, std::vector{target_of(alone), target_of(other)}}) {
      World world(world_of(targets), 1);
      const std::vector<double> masses{25e3, 25e3, 25e3, 20e3, 20e3};
      const double begun = kinetic_energy(world.sample(0.0), masses);
      double least = begun;
      bool coupled = false;
      for (int i = 1; i <= 1000; ++i) {
        const TruthSnapshot truth = world.sample(0.02 * i);
        const auto spring = [&](std::size_t ahead, std::size_t behind) {
          const double stretch =
              truth.objects[ahead].position.x() - truth.objects[behind].position.x() - 10.0;
          coupled = coupled || (ahead == 4 && stretch <= 0.0);
          if (ahead == 4 && !coupled) return 0.0;
          const double beyond = std::max(0.0, std::abs(stretch) - slack);
          return 0.5 * stiffness * beyond * beyond;
        };
        const double energy = kinetic_energy(truth, masses) + spring(0, 1) + spring(1, 2) +
                              spring(3, 4) + spring(4, 0);
        double momentum = 0.0;
        for (std::size_t k = 0; k < 5; ++k) momentum += masses[k] * truth.objects[k].velocity.x();
        ASSERT_NEAR(momentum, 150e3, 1e-6) << slack << ' ' << i;
        ASSERT_LT(energy, least + 1e-6 * begun) << slack << ' ' << i;
        least = std::min(least, energy);
      }
      EXPECT_GT(least, (1.0 - 1e-3) * begun) << slack;  // what the steps' error takes
      EXPECT_TRUE(coupled);
    }
  }
}

// Derived: without damping and couplings, buffers give all back: v₁' = (m₁ − m₂)/(m₁ + m₂) v and
// v₂' = 2 m₁/(m₁ + m₂) v, after a contact of π √(μ/k) with μ = m₁ m₂/(m₁ + m₂).
TEST(Shunting, BuffersElastically) {
  Train train = free_train(1, 60e3, 1.5);
  train.ahead = {CarsAhead{25.0, 1, 20e3, 0.0, false}};
  World world(world_of({target_of(train)}), 1);
  const double reduced = 15e3;
  const double contact = portable::kPi * std::sqrt(reduced / 1e7);
  EXPECT_NEAR(world.sample(10.0 - 1e-3).objects[0].velocity.x(), 1.5, 1e-9);
  const TruthSnapshot middle = world.sample(10.0 + 0.5 * contact);
  EXPECT_NEAR(middle.objects[1].position.x() - middle.objects[0].position.x(),
              10.0 - 1.5 * std::sqrt(reduced / 1e7), 1e-6);
  const TruthSnapshot after = world.sample(10.0 + contact + 1e-3);
  EXPECT_NEAR(after.objects[0].velocity.x(), 0.75, 1e-5);
  EXPECT_NEAR(after.objects[1].velocity.x(), 2.25, 1e-5);
}

// Derived: an undamped buffer stop is pressed in by v √(m/k) and throws a car back with its speed.
TEST(Shunting, EndsAtABufferStop) {
  Train train = free_train(1, 40e3, 2.0);
  train.buffer_stop = BufferStop{25.0, 4e6, 0.0};
  World world(world_of({target_of(train)}), 1);
  const double deepest = 2.0 * std::sqrt(0.01);
  EXPECT_NEAR(state_at(world, 10.0 + 0.5 * portable::kPi * 0.1).position.x(), 20.0 + deepest, 1e-6);
  EXPECT_NEAR(state_at(world, 10.0 + portable::kPi * 0.1 + 0.01).velocity.x(), -2.0, 1e-5);
}

// Derived: two trains that are driven towards each other on one track for 20 s close the gap
// between them by ½ (a₁ + a₂) t², the rest at the speed that they have, and couple: momentum.
TEST(Shunting, MeetsAnotherDrivenTrain) {
  Train train = free_train(2, 100e3, 0.0, {phase_at(0.0, Force{20e3})});
  train.couplers->damping = 2e5;
  CarsAhead other{210.0, 2,    25e3,
                  0.0,   true, {phase_at(0.0, Force{-20e3}), phase_at(20.0, Coast{})}};
  train.ahead = {other};
  train.drive.push_back(phase_at(20.0, Coast{}));
  WorldConfig config = world_of({target_of(train)});
  config.record.events = true;
  World world(config, 1);
  const TruthSnapshot before = world.sample(19.0);
  EXPECT_NEAR(before.objects[0].velocity.x(), 0.2 * 19.0, 0.01);
  EXPECT_NEAR(before.objects[3].velocity.x(), -0.4 * 19.0, 0.02);
  const double first = 0.2 * 20.0;
  const double second = -0.4 * 20.0;
  const double coasting = (200.0 - 0.5 * 0.6 * 400.0) / (first - second);
  const TruthSnapshot after = world.sample(60.0);
  for (const TruthState& car : after.objects) {
    EXPECT_NEAR(car.velocity.x(), (100e3 * first + 50e3 * second) / 150e3, 1e-2);
  }
  ASSERT_EQ(world.events().size(), 1u);
  EXPECT_EQ(world.events()[0].kind, EventKind::kCoupling);
  EXPECT_NEAR(world.events()[0].time, 20.0 + coasting, 0.05);
}

// Derived: a pull F on the first of n equal cars passes on F (n − i)/n to those behind the i-th.
TEST(Shunting, RecordsTheForcesInItsCouplers) {
  Train train = free_train(4, 80e3, 0.0, {phase_at(0.0, Force{20e3})});
  train.couplers->damping = 2e5;
  WorldConfig config = world_of({target_of(train)});
  config.record.columns = {TruthColumn::kCouplerForce};
  World world(config, 1);
  const TruthSnapshot truth = world.sample(60.0);
  ASSERT_EQ(truth.objects.size(), 4u);
  const double least = 20e3 * 1e-3;  // the springs still swing a little
  EXPECT_NEAR(truth.objects[0].coupler_force.value(), 15e3, least);
  EXPECT_NEAR(truth.objects[1].coupler_force.value(), 10e3, least);
  EXPECT_NEAR(truth.objects[2].coupler_force.value(), 5e3, least);
  EXPECT_FALSE(truth.objects[3].coupler_force.has_value());
}

// Derived: buffers that touch are told of once, with the momentum (m₁ m₂/(m₁ + m₂)) Δv that makes
// them equally fast; a buffer stop takes all.
TEST(Shunting, TellsOfBuffersThatTouch) {
  const auto events_of = [](std::vector<Target> targets) {
    WorldConfig config = world_of(std::move(targets));
    config.record.events = true;
    World world(config, 1);
    world.sample(60.0);
    return world.events();
  };
  Train one = free_train(1, 100e3, 5.0);
  one.couples = false;
  Train other = one;
  other.mass = 50e3;
  other.speed = 0.0;
  other.start = 100.0;
  Train pusher = one;
  pusher.ahead = {CarsAhead{100.0, 1, 50e3, 0.0, false}};
  Train stopped = one;
  stopped.buffer_stop = BufferStop{};
  stopped.buffer_stop->place = 120.0;
  const double passed = 100e3 * 50e3 / 150e3 * 5.0;
  for (const auto& [events, impulse] :
       {std::pair(events_of({target_of(one), target_of(other)}), passed),
        std::pair(events_of({target_of(pusher)}), passed),
        std::pair(events_of({target_of(stopped)}), 500e3)}) {
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, EventKind::kContact);
    EXPECT_NEAR(events[0].impulse.x(), -impulse, 1e-3 * impulse);
  }
}

// Property: a stop that cannot be kept is said, once, whether or not events are recorded; one that
// can be kept is not.
TEST(Shunting, SaysThatAStopWasRunPast) {
  for (const double begins : {0.0, 1900.0}) {
    Train train = free_train(3, 100e3, 30.0, {phase_at_position(begins, StationStop{2000.0})});
    train.couplers.reset();
    train.service_brake = 0.5;
    train.emergency_brake = 1.0;
    World world(world_of({target_of(train)}), 1);
    EXPECT_EQ(state_at(world, 200.0).velocity.x(), 0.0);
    if (begins == 0.0) {
      EXPECT_TRUE(world.events().empty());
      EXPECT_NEAR(state_at(world, 200.0).position.x(), 2000.0, 0.5);
      continue;
    }
    ASSERT_EQ(world.events().size(), 1u);
    EXPECT_EQ(world.events()[0].kind, EventKind::kOverrun);
    EXPECT_GT(world.events()[0].position.x(), 2000.0);
    EXPECT_LT(world.events()[0].position.x(), 2001.0);
  }
}

// Derived: of a rigid train of n cars those brake that the pipe has reached, after 0, L/c, 2L/c, …:
// v(t) = v − (b/n) Σ B(t − i L/c), with B(s) = s²/2r while the brake builds up and s − r/2 then;
// with the locomotive's brake alone b m₁/m.
TEST(Shunting, BrakesCarByCar) {
  Train train = free_train(5, 100e3, 20.0, {phase_at(1.0, Brake{})});
  train.couplers.reset();
  train.track_every_car = false;
  train.service_brake = 0.5;
  train.service_brake_build_up = 0.4;
  train.brake_pipe_speed = 20.0;  // slow, to be seen: 0.5 s from car to car
  World world(world_of({target_of(train)}), 1);
  for (const double time : {1.2, 1.7, 2.6, 5.0}) {
    double lost = 0.0;
    for (int i = 0; i < 5; ++i) {
      const double since = std::max(0.0, time - 1.0 - 0.5 * i);
      lost += 0.1 * (since < 0.4 ? since * since / 0.8 : since - 0.2);
    }
    EXPECT_NEAR(state_at(world, time).velocity.x(), 20.0 - lost, 1e-9) << time;
  }
  train.brake_pipe_speed.reset();
  train.leading_mass = 60e3;
  train.drive = {phase_at(1.0, Brake{BrakeKind::kLocomotive})};
  World alone(world_of({target_of(train)}), 1);
  EXPECT_NEAR(state_at(alone, 11.0).velocity.x(), 20.0 - 0.5 * 0.6 * 9.8, 1e-9);
}

// Derived: with brakes stronger than wheels can bear, these slide at a(v) = μ(v) f g of Curtius &
// Kniffler's μ, and the way to a stand is ∫ v dv / a(v), in closed form.
TEST(Shunting, StopsAtTheLimitOfAdhesion) {
  for (const double adhesion : {0.15, 0.4}) {
    for (const double speed : {8.0, 30.0}) {
      Train train = free_train(4, 100e3, speed, {phase_at(0.0, Brake{BrakeKind::kEmergency})});
      train.couplers.reset();
      train.track_every_car = false;
      train.emergency_brake = 5.0;
      train.emergency_brake_build_up = 0.0;
      train.adhesion = adhesion;
      World world(world_of({target_of(train)}), 1);
      // v dv / a = (44 + 3.6 v) v dv / (c (p + q v))
      const double c = adhesion * kStandardGravity;
      const double q = 0.161 * 3.6;
      const double p = 7.5 + 0.161 * 44.0;
      const double linear = (44.0 - 3.6 * p / q) / q;
      const double way = (1.8 / q * speed * speed + linear * speed -
                          linear * p / q * portable::log(1.0 + q * speed / p)) /
                         c;
      const TruthState stopped = state_at(world, 200.0);
      EXPECT_EQ(stopped.velocity.x(), 0.0);
      EXPECT_NEAR(stopped.position.x(), way, 1e-5 * way) << adhesion << ' ' << speed;
    }
  }
}

/// The run-in of sprung cars that brake one after the other, written out: Euler steps of 5 µs.
std::vector<double> run_in_by_hand(double until) {
  constexpr double kStep = 5e-6;
  std::vector<double> place{0.0, -10.0, -20.0, -30.0};
  std::vector<double> speed(4, 15.0);
  for (double time = 0.0; time < until; time += kStep) {
    std::vector<double> rate(4, 0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      const double since = time - 0.1 * static_cast<double>(i);
      rate[i] -= 0.8 * std::clamp(since / 0.5, 0.0, 1.0);
      if (i == 0) continue;
      const double stretch = place[i - 1] - place[i] - 10.0;
      if (std::abs(stretch) <= 0.02) continue;
      const double pull =
          1e7 * (stretch - std::copysign(0.02, stretch)) + 1e5 * (speed[i - 1] - speed[i]);
      rate[i - 1] -= pull / 25e3;
      rate[i] += pull / 25e3;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      speed[i] += kStep * rate[i];
      place[i] += kStep * speed[i];
    }
  }
  return place;
}

// Derived: the run-in of a train whose brakes act first at its head, against that integration.
TEST(Shunting, RunsInWhenTheHeadBrakesFirst) {
  Train train = free_train(4, 100e3, 15.0, {phase_at(0.0, Brake{})});
  train.couplers = Couplers{1e7, 1e5, 0.02};
  train.service_brake = 0.8;
  train.service_brake_build_up = 0.5;
  train.brake_pipe_speed = 100.0;
  World world(world_of({target_of(train)}), 1);
  for (const double time : {0.3, 0.9, 2.0}) {
    const std::vector<double> wanted = run_in_by_hand(time);
    const TruthSnapshot truth = world.sample(time);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(truth.objects[i].position.x(), wanted[i], 5e-4) << time;
    }
  }
  // It runs in: the last car comes up by more than the play.
  World again(world_of({target_of(train)}), 1);
  double shortest = 30.0;
  for (int i = 0; i < 100; ++i) {
    const TruthSnapshot truth = again.sample(0.02 * i);
    shortest = std::min(shortest, truth.objects[0].position.x() - truth.objects[3].position.x());
  }
  EXPECT_LT(shortest, 30.0 - 3.0 * 0.02);
}

// Property: the driver keeps the limits, from the place where they begin until the last car has
// left, and takes no longer than he must: the speed before is that of the braking he plans with.
TEST(Shunting, KeepsSpeedLimits) {
  for (const DriveCommand& command : {DriveCommand(TargetSpeed{30.0}), DriveCommand(Traction{1.0}),
                                      DriveCommand(Accelerate{0.4})}) {
    Train train = free_train(5, 200e3, 30.0, {phase_at(0.0, command)});
    train.couplers.reset();
    train.track_every_car = false;
    train.service_brake = 0.5;
    train.speed_limits = {SpeedLimit{2000.0, 2300.0, 10.0}, SpeedLimit{2000.0, 9000.0, 25.0}};
    World world(world_of({target_of(train)}), 1);
    bool was_slow = false;
    for (int i = 0; i < 2400; ++i) {
      const TruthState state = state_at(world, 0.1 * i);
      const double place = state.position.x();
      if (place >= 2000.0 && place <= 2340.0) {
        EXPECT_LT(state.velocity.x(), 10.2) << place;
        was_slow = true;
      }
      if (place >= 2000.0 && place <= 9000.0) {
        EXPECT_LT(state.velocity.x(), 25.2) << place;
      }
      if (place > 1400.0 && place < 2000.0) {
        const double planned = std::sqrt(100.0 + 2.0 * 0.45 * (2000.0 - place));
        EXPECT_GT(state.velocity.x(), std::min(28.0, planned - 1.0)) << place;
      }
    }
    EXPECT_TRUE(was_slow);
    EXPECT_GT(state_at(world, 240.0).position.x(), 2800.0);
  }
}

}  // namespace
}  // namespace ghtrack

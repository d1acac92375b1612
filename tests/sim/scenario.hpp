#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sim/world.hpp"

namespace ghtrack {

inline Target target_of(Regime motion, std::string name = {}) {
  Target target;
  target.name = std::move(name);
  target.motion = std::move(motion);
  return target;
}

inline WorldConfig world_of(std::vector<Target> targets) {
  WorldConfig world;
  world.targets = std::move(targets);
  return world;
}

/// Without gravity, so that tracks lie flat.
inline WorldConfig seen_from_above(std::vector<Target> targets) {
  WorldConfig world = world_of(std::move(targets));
  world.environment.gravity = 0.0;
  return world;
}

/// A ball without aerodynamics.
inline ThrownBall plain_ball(const Vec2& position, const Vec2& velocity) {
  ThrownBall ball;
  ball.position = position;
  ball.velocity = velocity;
  ball.drag = 0.0;
  ball.lift = LiftModel::kNone;
  ball.spin_decay = 0.0;
  return ball;
}

/// A train of one car that keeps its speed until the first phase of its drive.
inline Train single_car(double start, double speed, std::vector<DrivePhase> drive = {}) {
  Train train;
  train.cars = 1;
  train.start = start;
  train.speed = speed;
  train.drive = std::move(drive);
  return train;
}

/// Cars of 10 m that nothing holds back.
inline Train free_cars(int cars, double mass, double start, double speed,
                       std::vector<DrivePhase> drive = {}) {
  Train train = single_car(start, speed, std::move(drive));
  train.cars = cars;
  train.car_length = 10.0;
  train.mass = mass;
  train.rotating_mass = 1.0;
  train.davis_a = train.davis_b = train.davis_c = 0.0;
  train.curve_resistance = 0.0;
  return train;
}

/// Of the first objects, which have these masses.
inline double kinetic_energy(const TruthSnapshot& truth, const std::vector<double>& masses) {
  double sum = 0.0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    sum += 0.5 * masses[i] * truth.objects[i].velocity.squaredNorm();
  }
  return sum;
}

inline DrivePhase phase_at(double time, DriveCommand command) {
  DrivePhase phase;
  phase.at = time;
  phase.command = command;
  return phase;
}

inline DrivePhase phase_at_position(double position, DriveCommand command) {
  DrivePhase phase;
  phase.at_position = position;
  phase.command = command;
  return phase;
}

/// State of the first object at a time.
inline TruthState state_at(World& world, double time) { return world.sample(time).objects.at(0); }

}  // namespace ghtrack

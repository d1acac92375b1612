#pragma once

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

#include "tests/sim/golden_worlds.hpp"

#include <bit>
#include <string>
#include <vector>

#include "tests/sim/scenario.hpp"

namespace ghtrack {

WorldConfig busy_world() {
  Train train = single_car(0.0, 20.0, {phase_at(1.0, Accelerate{0.3}), phase_at(2.0, Brake{})});
  train.cars = 4;
  train.track = {Straight{30.0}, Clothoid{40.0, 300.0}, Curve{300.0, 30.0, {}, 0.0}};
  train.position = Vec2(-20.0, 30.0);
  std::vector<Target> targets{target_of(train, "express")};
  for (int i = 0; i < 6; ++i) {
    ThrownBall ball;
    ball.position = Vec2(3.0 * i, 2.0);
    ball.velocity = Vec2(12.0 - 4.0 * i, 8.0 + i);
    ball.spin_rpm = 300.0 * i;
    targets.push_back(target_of(ball, "ball " + std::to_string(i)));
  }
  for (int i = 0; i < 5; ++i) {
    Balloon balloon;
    balloon.position = Vec2(0.3 * i, 3.0 + 0.05 * i);
    balloon.velocity = Vec2(-0.5 * i, 0.0);
    targets.push_back(target_of(balloon, "balloon " + std::to_string(i)));
  }
  Drone drone;
  drone.position = Vec2(-40.0, 12.0);
  drone.plan = {{0.5, FlyTo{Vec2(-25.0, 15.0)}}, {2.5, KeepVelocity{Vec2(3.0, -1.0)}}};
  targets.push_back(target_of(drone, "courier"));
  Target parcel = target_of(plain_ball(Vec2(0.0, -0.5), Vec2(0.0, -1.0)), "parcel");
  parcel.appears = 1.7;
  parcel.released_by = "courier";
  targets.push_back(parcel);
  ThrownBall club;
  club.position = Vec2(-60.0, 1.2);
  club.juggle = Juggling{Vec2(-59.4, 1.2), 0.7, 0.2};
  Target clubs = target_of(club, "club");
  clubs.repeat = Repeat{3, 0.6, Vec2::Zero()};
  targets.push_back(clubs);
  Target swarm = target_of(Balloon{}, "swarm");
  std::get<Balloon>(swarm.motion).position = Vec2(-120.0, 20.0);
  swarm.grid = Grid{2, 2, Vec2(12.0, 12.0)};
  swarm.random = RandomCopies{2, 3, Vec2(8.0, 8.0), Vec2(1.0, 1.0), 0.5};
  targets.push_back(swarm);
  WorldConfig world = world_of(targets);
  world.environment.ground = Ground{0.0, 0.7, 0.3};
  world.environment.ground->profile = {Vec2(-30.0, 0.0), Vec2(-20.0, 1.0), Vec2(-12.0, 0.0)};
  world.environment.boxes = {SolidBox{Vec2(12.0, 0.5), Vec2(1.0, 1.0), 20.0}};
  world.environment.walls = {Wall{Vec2(25.0, 0.0), Vec2(30.0, 10.0), {}, {}}};
  world.environment.wind.mean = Vec2(8.0, 0.0);
  world.environment.wind.turbulence.model = Dryden{0.2, 10.0, {}};
  return world;
}

WorldConfig stormy_world() {
  std::vector<Target> targets;
  // Five presets from the first on, so that a new one changes no recorded bits.
  for (const ThrownBall& preset : ThrownBall::presets().first(5)) {
    ThrownBall ball = preset;
    const auto number = static_cast<double>(targets.size());
    ball.position = Vec2(100.0 * number, 3.0);
    ball.speed = 15.0 + 4.0 * number;
    ball.angle_deg = 60.0 - 8.0 * number;
    ball.spin = 150.0 - 70.0 * number;
    targets.push_back(target_of(ball, ball.type));
  }
  Train train =
      single_car(23000.0, 25.0,
                 {phase_at(0.5, TargetSpeed{22.0}),
                  phase_at_position(23060.0, StationStop{23400.0}), phase_at(60.0, Traction{0.7})});
  train.cars = 6;
  train.mass = 300e3;
  train.leading_mass = 80e3;
  train.couplers = Couplers{3e7, 1e6, 0.02};
  train.track_every_car = true;
  train.grades = {Grade{23000.0, 24000.0, 0.004}};
  train.track = {Straight{22900.0}, Curve{500.0, {}, 400.0, 80.0}};
  targets.push_back(target_of(train, "local"));
  for (const bool fluid_acceleration : {false, true}) {
    Balloon balloon;
    balloon.position = Vec2(fluid_acceleration ? -300.0 : 900.0, 100.0);
    balloon.fluid_acceleration = fluid_acceleration;
    targets.push_back(target_of(balloon, fluid_acceleration ? "quick" : "lazy"));
  }
  WorldConfig world = world_of(targets);
  world.environment.ground = Ground{};
  WindConfig& wind = world.environment.wind;
  wind.shear.emplace(LogarithmicShear{});
  wind.gusts = {StepGust{0.51, Vec2(9.0, 0.0)}, OneMinusCosineGust{1.2, 0.7, Vec2(-5.0, 3.0)}};
  wind.vortices = {RankineVortex{Vec2(0.0, 20.0), Vec2(3.0, 0.0), 12.0, 15.0, 0.6},
                   HollandVortex{Vec2(2000.0, -1000.0), Vec2(1.0, 2.0), 15.0, 3000.0}};
  wind.modes = {WindMode{Vec2(2.0, 1.0), 3.0, Vec2(0.1, 0.2)},
                WindMode{Vec2(0.5, 0.7), 11.0, Vec2(0.3, 0.4)}};
  wind.turbulence.model = OrnsteinUhlenbeck{3.0, 0.8, 25.0};
  return world;
}

std::uint64_t truth_hash(const TruthSnapshot& truth, std::uint64_t hash) {
  const auto add = [&hash](double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3;
  };
  for (const TruthState& object : truth.objects) {
    for (const Vec2& v : {object.position, object.velocity, object.acceleration}) {
      add(v.x());
      add(v.y());
    }
  }
  return hash;
}

std::uint64_t truth_hash(const WorldConfig& config, double duration, double rate) {
  World world(config, 7);
  std::uint64_t hash = 0;
  const int samples = static_cast<int>(duration * rate);
  for (int i = 0; i <= samples; ++i) hash = truth_hash(world.sample(i / rate), hash);
  return hash;
}

}  // namespace ghtrack

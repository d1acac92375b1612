#include "tests/sim/energy_world.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <variant>
#include <vector>

#include "sim/random.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

constexpr double kDepth = -3.0;  // below every ground [m]

ThrownBall random_ball(Stream& stream) {
  const double radius = 0.03 + 0.15 * stream.uniform();
  const double density = 300.0 * std::exp(2.0 * stream.uniform());
  const double x = -3.0 + 6.0 * stream.uniform();
  const double y = 2.5 + 3.0 * stream.uniform();
  const double vx = 6.0 * (stream.uniform() - 0.5);
  const double vy = 6.0 * (stream.uniform() - 0.5);
  ThrownBall ball = plain_ball(Vec2(x, y), Vec2(vx, vy));
  ball.radius = radius;
  ball.mass = density * 4.19 * radius * radius * radius;
  ball.inertia = stream.uniform() < 0.5 ? 0.4 : 0.667;
  const double kind = stream.uniform();
  const double between = stream.uniform();
  ball.restitution = kind < 0.15 ? 0.0 : kind > 0.85 ? 1.0 : between;
  const double rough = stream.uniform();
  const double friction = stream.uniform();
  ball.friction = rough < 0.2 ? 0.0 : 1.2 * friction;
  const double rolling = stream.uniform();
  ball.rolling = rolling < 0.5 ? 0.0 : 0.2 * (rolling - 0.5);
  const double spin = stream.uniform();
  ball.spin = 60.0 * (spin - 0.5);
  return ball;
}

EnvironmentConfig random_surroundings(Stream& stream) {
  EnvironmentConfig environment;
  environment.air.density = 0.0;
  const double kind = stream.uniform();
  Ground ground;
  if (kind < 0.25) {
    const double slope = 0.2 + 1.5 * stream.uniform();
    ground.profile = {Vec2(-6.0, 6.0 * slope - 1.0), Vec2(0.0, -1.0), Vec2(6.0, 6.0 * slope - 1.0)};
  } else if (kind < 0.5) {
    for (int i = 0; i < 7; ++i) {
      const double height = stream.uniform();
      ground.profile.emplace_back(-6.0 + 2.0 * i, -1.0 + 2.0 * height);
    }
    ground.smooth = stream.uniform() < 0.7;
  }
  environment.ground = ground;
  environment.walls = {Wall{Vec2(-4.0, -2.0), Vec2(-4.0, 9.0)},
                       Wall{Vec2(4.0, -2.0), Vec2(4.0, 9.0)}};
  const int ramps = static_cast<int>(4.0 * stream.uniform());
  for (int i = 0; i < ramps; ++i) {
    const double x = 6.0 * (stream.uniform() - 0.5);
    const double y = 1.2 + stream.uniform();
    const double run = 2.0 * (stream.uniform() - 0.5);
    const double rise = 0.8 * (stream.uniform() - 0.5);
    if (std::abs(run) < 0.1) continue;
    environment.walls.push_back(Wall{Vec2(x, y), Vec2(x + run, y + rise)});
  }
  if (stream.uniform() < 0.4) {
    const double x = 4.0 * (stream.uniform() - 0.5);
    const double angle = 90.0 * stream.uniform();
    environment.boxes = {
        SolidBox{.center = Vec2(x, 0.5), .size = Vec2(1.0, 0.7), .angle_deg = angle}};
  }
  return environment;
}

}  // namespace

WorldConfig energy_world(std::uint64_t seed) {
  Stream stream(seed, Purpose::kGeneration, key_of("energy"), 0);
  WorldConfig config;
  config.environment = random_surroundings(stream);
  const double rate = stream.uniform();
  config.physics.rate = rate < 0.3 ? 60.0 : 240.0;
  const int balls = 1 + static_cast<int>(12.0 * stream.uniform());
  for (int i = 0; i < balls; ++i) {
    config.targets.push_back(target_of(random_ball(stream), "ball " + std::to_string(i)));
    if (!find_problems(config.targets, config.environment).empty()) config.targets.pop_back();
  }
  // A column, each ball on top of the one below.
  if (stream.uniform() < 0.4) {
    const ThrownBall like = random_ball(stream);
    const int count = 2 + static_cast<int>(4.0 * stream.uniform());
    for (int i = 0; i < count; ++i) {
      ThrownBall ball = like;
      ball.position = Vec2(-3.5, 2.3 + 2.0 * like.radius * i);
      ball.velocity = Vec2::Zero();
      config.targets.push_back(target_of(ball, "column " + std::to_string(i)));
      if (!find_problems(config.targets, config.environment).empty()) config.targets.pop_back();
    }
  }
  return config;
}

namespace {

double radius_of(const WorldConfig& config, std::size_t ball) {
  return std::get<ThrownBall>(config.targets[ball].motion).radius;
}

/// Of the balls that touch each other: for each the first of those that hang together with it.
std::vector<std::size_t> heaps(const WorldConfig& config, const TruthSnapshot& truth) {
  constexpr double kTouching = 1e-6;  // [m]
  std::vector<std::size_t> first(truth.objects.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    first[i] = i;
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = (truth.objects[i].position - truth.objects[j].position).norm();
      if (apart > radius_of(config, i) + radius_of(config, j) + kTouching) continue;
      const std::size_t least = std::min(first[i], first[j]);
      const std::size_t most = std::max(first[i], first[j]);
      std::replace(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(i) + 1, most, least);
    }
  }
  return first;
}

/// The largest velocity [m/s] or acceleration [m/s²] of a ball that rests: that stays where it is
/// from the sample before to the one after with all that it hangs together with, and is not struck
/// in between: it may be back in its seat by then. A ball at the top of its hop, or one that
/// another is about to push, is so slow at one sample only.
double unrest(const WorldConfig& config, const TruthSnapshot& before, const TruthSnapshot& now,
              const TruthSnapshot& after, const std::vector<WorldEvent>& events) {
  constexpr double kStill = 1e-9;   // [m]
  constexpr double kStruck = 1e-3;  // change of velocity [m/s]
  const std::vector<std::size_t> heap = heaps(config, now);
  const std::size_t count = now.objects.size();
  if (before.objects.size() != count || after.objects.size() != count) return 0.0;
  std::vector<bool> stands(count, true);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2& here = now.objects[k].position;
    const bool moves = (here - before.objects[k].position).norm() > kStill ||
                       (here - after.objects[k].position).norm() > kStill;
    if (moves) stands[heap[k]] = false;
  }
  for (const WorldEvent& event : events) {
    if (event.time <= before.time || event.time >= after.time) continue;
    const auto struck = static_cast<std::size_t>(event.object);
    const auto& ball = std::get<ThrownBall>(config.targets[struck].motion);
    if (event.impulse.norm() < kStruck * ball.mass) continue;
    stands[heap[struck]] = false;
    if (event.other >= 0) stands[heap[static_cast<std::size_t>(event.other)]] = false;
  }
  double most = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const TruthState& state = now.objects[k];
    if (stands[heap[k]]) most = std::max({most, state.velocity.norm(), state.acceleration.norm()});
  }
  return most;
}

/// The least gap between a ball and all else [m].
double gap_around(const WorldConfig& config, const Environment& environment,
                  const TruthSnapshot& truth, std::size_t k) {
  const auto radius = [&](std::size_t i) { return radius_of(config, i); };
  const Vec2& position = truth.objects[k].position;
  double least = 1e9;
  for (const Surface& surface : environment.surfaces()) {
    least = std::min(least, surface.contact(position).distance - radius(k));
  }
  for (std::size_t j = 0; j < truth.objects.size(); ++j) {
    if (j == k) continue;
    const double apart = (position - truth.objects[j].position).norm();
    least = std::min(least, apart - radius(k) - radius(j));
  }
  return least;
}

}  // namespace

EnergyRun run_energy_world(std::uint64_t seed) {
  const std::clock_t begin = std::clock();
  WorldConfig config = energy_world(seed);
  config.record.events = true;
  World world(config, seed);
  EnergyRun result;
  double least = 0.0;
  std::vector<TruthSnapshot> samples;
  for (int i = 0; i <= 120; ++i) {
    const TruthSnapshot& truth = samples.emplace_back(world.sample(0.05 * i));
    double energy = 0.0;
    for (std::size_t k = 0; k < truth.objects.size(); ++k) {
      const auto& ball = std::get<ThrownBall>(config.targets[k].motion);
      const double rim = truth.bodies[k].spin * ball.radius;
      const TruthState& state = truth.objects[k];
      energy += ball.mass * (kStandardGravity * (state.position.y() - kDepth) +
                             0.5 * state.velocity.squaredNorm() + 0.5 * ball.inertia * rim * rim);
      const double gap = gap_around(config, world.environment(), truth, k);
      result.lowest = std::min(result.lowest, gap);
      if (state.acceleration == Vec2::Zero() && gap > 1e-8) ++result.afloat;
    }
    if (i == 0) result.begun = least = energy;
    result.most_gained = std::max(result.most_gained, energy - least);
    least = std::min(least, energy);
  }
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double now = unrest(config, samples[i - 1], samples[i], samples[i + 1], world.events());
    result.most_unrest = std::max(result.most_unrest, now);
  }
  result.collisions_missed = world.missed_collisions();
  result.cpu_time = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace ghtrack

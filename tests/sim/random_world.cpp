#include "tests/sim/random_world.hpp"

#include <cmath>
#include <ctime>
#include <variant>

#include "tests/sim/random_config.hpp"

namespace ghtrack {

WorldConfig random_world(std::uint64_t seed) {
  RandomConfig random(seed);
  Stream stream(seed, Purpose::kGeneration, 1, 0);
  WorldConfig config;
  config.environment = random.draw<EnvironmentConfig>();
  config.physics = random.draw<PhysicsConfig>();
  const int count = 1 + static_cast<int>(stream.uniform() * 6.0);
  const bool crowded = stream.uniform() < 0.5;
  for (int i = 0; i < count; ++i) {
    Target target = random.draw<Target>();
    target.name.clear();
    target.appears = std::fmod(target.appears, 0.3);
    target.disappears.reset();
    target.released_by.reset();
    if (!config.targets.empty() && stream.uniform() < 0.2) {
      target.released_by = spell_out(config.targets).front().name;
    }
    if (target.grid) target.grid->columns = target.grid->rows = 2;
    if (target.random) target.random->count = std::min(target.random->count, 3);
    if (target.repeat) target.repeat->count = std::min(target.repeat->count, 2);
    if (crowded) {
      const double x = stream.uniform();
      const double y = stream.uniform();
      std::visit([&](auto& motion) { motion.position = Vec2(3.0 * x, 3.0 * y); }, target.motion);
    }
    config.targets.push_back(target);
    if (!find_problems(config.targets, config.environment).empty()) config.targets.pop_back();
  }
  return config;
}

RandomRun run_random_world(std::uint64_t seed) {
  const std::clock_t begin = std::clock();
  World world(random_world(seed), seed);
  RandomRun result;
  for (int i = 0; i <= 10; ++i) {
    const TruthSnapshot truth = world.sample(0.05 * i);
    for (const TruthState& state : truth.objects) {
      result.finite = result.finite && state.position.allFinite() && state.velocity.allFinite();
    }
  }
  result.collisions_missed = world.missed_collisions();
  result.cpu_time = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace ghtrack

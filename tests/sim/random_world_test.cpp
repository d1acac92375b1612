#include <gtest/gtest.h>

#include <cmath>

#include "sim/world.hpp"
#include "tests/sim/random_config.hpp"

namespace ghtrack {
namespace {

/// A world whose every number is random within what its description allows; half of them with the
/// targets so close together that they meet.
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
    if (crowded) {
      const double x = stream.uniform();
      const double y = stream.uniform();
      std::visit([&](auto& motion) { motion.position = Vec2(3.0 * x, 3.0 * y); }, target.motion);
    }
    config.targets.push_back(target);
    if (!find_problems(config.targets).empty()) config.targets.pop_back();
  }
  return config;
}

// Property: whatever a scene may say, the world neither aborts nor produces a number that is not
// finite. Debian's Box2D aborts on NaN, on bodies of no size and on much else.
TEST(RandomWorld, NeverFails) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    World world(random_world(seed), seed);
    for (int i = 0; i <= 10; ++i) {
      const TruthSnapshot truth = world.sample(0.05 * i);
      for (const TruthState& state : truth.objects) {
        ASSERT_TRUE(state.position.allFinite());
        ASSERT_TRUE(state.velocity.allFinite());
      }
    }
  }
}

}  // namespace
}  // namespace ghtrack

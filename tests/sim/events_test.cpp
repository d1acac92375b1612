#include <gtest/gtest.h>

#include "tests/sim/golden_worlds.hpp"
#include "tests/sim/scenario.hpp"

namespace ghtrack {
namespace {

ThrownBall hard_ball(const Vec2& position, const Vec2& velocity) {
  ThrownBall ball = plain_ball(position, velocity);
  ball.radius = 0.1;
  ball.mass = 2.0;
  ball.restitution = 0.8;
  ball.friction = 0.0;
  return ball;
}

// Derived: two equal balls that meet at v exchange m (1 + e) v / 2, which is told of one of them; a
// wall gives m (1 + e) v to a ball that strikes it.
TEST(Events, SayWhoStruckWhatAndHowHard) {
  WorldConfig config = world_of({target_of(hard_ball(Vec2(-1.0, 0.0), Vec2(3.0, 0.0)), "cue"),
                                 target_of(hard_ball(Vec2(0.2, 0.0), Vec2::Zero()), "red"),
                                 target_of(hard_ball(Vec2(0.0, 9.0), Vec2(0.0, 4.0)), "lone")});
  config.environment.gravity = 0.0;
  config.environment.air.density = 0.0;
  config.environment.walls = {Wall{Vec2(-9.0, -20.0), Vec2(-9.0, -10.0)},
                              Wall{Vec2(-1.0, 11.1), Vec2(1.0, 11.1)}};
  config.record.events = true;
  World world(config, 1);
  world.sample(1.0);
  ASSERT_EQ(world.events().size(), 2u);
  const WorldEvent& met = world.events()[0];
  EXPECT_NEAR(met.time, 1.0 / 3.0, 1e-9);
  EXPECT_EQ(met.object + met.other, 1);
  const double way = met.object == 0 ? -1.0 : 1.0;
  EXPECT_LT((met.impulse - Vec2(way * 2.0 * 1.8 * 3.0 / 2.0, 0.0)).norm(), 1e-9);
  const WorldEvent& wall = world.events()[1];
  EXPECT_NEAR(wall.time, 0.5, 1e-9);
  EXPECT_EQ(wall.object, 2);
  EXPECT_EQ(wall.other, -1);
  EXPECT_EQ(wall.surface, "walls[1]");
  EXPECT_LT((wall.impulse - Vec2(0.0, -2.0 * 1.8 * 4.0)).norm(), 1e-9);
}

// Property: to record changes nothing, the instants of sampling change nothing, and what is not
// asked for is not there.
TEST(Events, AreAQuestionNotAForce) {
  WorldConfig config = busy_world();
  World silent(config, 7);
  config.record = {true, {TruthColumn::kWind}};
  World telling(config, 7);
  World often(config, 7);
  EXPECT_EQ(truth_hash(telling.sample(4.0)), truth_hash(silent.sample(4.0)));
  for (int i = 0; i <= 400; ++i) often.sample(0.01 * i);
  EXPECT_TRUE(silent.events().empty());
  ASSERT_FALSE(telling.events().empty());
  ASSERT_EQ(often.events().size(), telling.events().size());
  for (std::size_t i = 0; i < telling.events().size(); ++i) {
    const WorldEvent& a = telling.events()[i];
    const WorldEvent& b = often.events()[i];
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.object, b.object);
    EXPECT_EQ(a.impulse, b.impulse);
    EXPECT_LE(telling.events()[i > 0 ? i - 1 : 0].time, a.time);
  }
}

// Property: the wind that is recorded is the wind where the object is.
TEST(Events, RecordTheWindAtTheObject) {
  WorldConfig config = world_of({target_of(hard_ball(Vec2(3.0, 50.0), Vec2::Zero()))});
  config.environment.wind.mean = Vec2(4.0, 1.0);
  World without(config, 1);
  EXPECT_EQ(state_at(without, 0.5).wind, Vec2::Zero());
  config.record.columns = {TruthColumn::kWind};
  World with(config, 1);
  EXPECT_EQ(state_at(with, 0.5).wind, Vec2(4.0, 1.0));
}

}  // namespace
}  // namespace ghtrack

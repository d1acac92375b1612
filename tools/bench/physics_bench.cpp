#include <benchmark/benchmark.h>
#include <box2d/box2d.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/world.hpp"

// The world beside bare Box2D that steps the same bodies at the same rate. The two take turns, so
// that a busy machine slows both alike, and the least time of each counts.

namespace ghtrack::bench {
namespace {

constexpr double kRate = 60.0;         // [Hz]
constexpr int kStepsPerTurn = 60;      // one second of simulated time
constexpr double kStartHeight = 50.0;  // [m]
constexpr float kBallRadius = 0.0366F;

template <class Work>
double seconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Steps of one second each, from fresh worlds: `World` is sampled once a second.
template <class MakeWorld, class MakeBox2d>
void compare(benchmark::State& state, int bodies, const MakeWorld& make_world,
             const MakeBox2d& make_box2d) {
  double ours = 1e9;
  double box2d = 1e9;
  for (auto _ : state) {
    World world = make_world();
    world.sample(0.0);
    ours = std::min(ours, seconds([&] { world.sample(kStepsPerTurn / kRate); }));
    auto bare = make_box2d();
    box2d = std::min(box2d, seconds([&] {
                       for (int i = 0; i < kStepsPerTurn; ++i) bare.step();
                     }));
  }
  const double body_steps = static_cast<double>(bodies) * kStepsPerTurn;
  state.counters["world_ns"] = 1e9 * ours / body_steps;  // per body and step
  state.counters["box2d_ns"] = 1e9 * box2d / body_steps;
  state.counters["ratio"] = ours / box2d;
}

Target target_of(Regime motion, int number) {
  Target target;
  target.name = "target " + std::to_string(number);
  target.motion = std::move(motion);
  return target;
}

struct Start {
  Vec2 position;
  Vec2 velocity;
};

WorldConfig world_of_balls(const std::vector<Start>& starts) {
  WorldConfig config;
  config.physics.rate = kRate;
  for (const Start& start : starts) {
    ThrownBall ball;
    ball.position = start.position;
    ball.velocity = start.velocity;
    ball.lift = LiftModel::kNone;
    ball.restitution = 1.0;
    ball.friction = 0.0;
    config.targets.push_back(target_of(ball, static_cast<int>(config.targets.size())));
  }
  return config;
}

/// The same in Box2D, as its manual has it.
class BareBalls {
 public:
  BareBalls(const std::vector<Start>& starts, bool drag, bool ground)
      : world_(std::make_unique<b2World>(b2Vec2(0.0F, -9.80665F))), drag_(drag) {
    world_->SetAllowSleeping(false);
    if (ground) {
      b2BodyDef definition;
      b2EdgeShape edge;
      edge.SetTwoSided({-1e4F, 0.0F}, {1e4F, 0.0F});
      world_->CreateBody(&definition)->CreateFixture(&edge, 0.0F);
    }
    for (const Start& start : starts) {
      b2BodyDef definition;
      definition.type = b2_dynamicBody;
      definition.position = {static_cast<float>(start.position.x()),
                             static_cast<float>(start.position.y())};
      definition.linearVelocity = {static_cast<float>(start.velocity.x()),
                                   static_cast<float>(start.velocity.y())};
      b2CircleShape disc;
      disc.m_radius = kBallRadius;
      b2FixtureDef fixture;
      fixture.shape = &disc;
      fixture.density = 0.145F / (b2_pi * kBallRadius * kBallRadius);
      fixture.restitution = 1.0F;
      fixture.friction = 0.0F;
      bodies_.push_back(world_->CreateBody(&definition));
      bodies_.back()->CreateFixture(&fixture);
    }
  }

  void step() {
    constexpr float kDrag = 0.5F * 1.2F * 0.35F * b2_pi * kBallRadius * kBallRadius;
    if (drag_) {
      for (b2Body* body : bodies_) {
        const b2Vec2 v = body->GetLinearVelocity();
        body->ApplyForceToCenter(-kDrag * v.Length() * v, true);
      }
    }
    world_->Step(static_cast<float>(1.0 / kRate), 8, 3);
  }

 private:
  std::unique_ptr<b2World> world_;
  std::vector<b2Body*> bodies_;
  bool drag_;
};

/// Balls side by side, all with the same velocity: they never meet.
std::vector<Start> flying(int count) {
  std::vector<Start> starts;
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    starts.push_back({{3.0 * (i % columns), kStartHeight + 3.0 * (i / columns)}, {8.0, 5.0}});
  }
  return starts;
}

void flying_balls(benchmark::State& state) {
  const auto starts = flying(static_cast<int>(state.range(0)));
  const WorldConfig config = world_of_balls(starts);
  compare(
      state, static_cast<int>(starts.size()), [&] { return World(config, 1); },
      [&] { return BareBalls(starts, true, false); });
}

/// Balls in a row that bounce on the ground with different phases.
void bouncing_balls(benchmark::State& state) {
  std::vector<Start> starts;
  for (int i = 0; i < state.range(0); ++i) {
    starts.push_back({{1.0 * i, 0.1 + 0.002 * (i % 500)}, {0.0, 0.0}});
  }
  WorldConfig config = world_of_balls(starts);
  config.environment.air.density = 0.0;
  config.environment.ground = Ground{};
  compare(
      state, static_cast<int>(starts.size()), [&] { return World(config, 1); },
      [&] { return BareBalls(starts, false, true); });
}

/// Boxes chained by rigid distance joints, the first of them pulled.
class BareTrain {
 public:
  explicit BareTrain(int cars) : world_(std::make_unique<b2World>(b2Vec2_zero)) {
    world_->SetAllowSleeping(false);
    b2Body* ahead = nullptr;
    for (int i = 0; i < cars; ++i) {
      b2BodyDef definition;
      definition.type = b2_dynamicBody;
      definition.position = {-25.0F * static_cast<float>(i), 0.0F};
      definition.linearVelocity = {20.0F, 0.0F};
      b2PolygonShape box;
      box.SetAsBox(12.0F, 1.5F);
      b2Body* car = world_->CreateBody(&definition);
      car->CreateFixture(&box, 80e3F / (24.0F * 3.0F));
      if (ahead == nullptr) {
        first_ = car;
      } else {
        b2DistanceJointDef joint;
        joint.Initialize(ahead, car, ahead->GetPosition() - b2Vec2(12.5F, 0.0F),
                         car->GetPosition() + b2Vec2(12.0F, 0.0F));
        world_->CreateJoint(&joint);
      }
      ahead = car;
    }
  }

  void step() {
    first_->ApplyForceToCenter({300e3F, 0.0F}, true);
    world_->Step(static_cast<float>(1.0 / kRate), 8, 3);
  }

 private:
  std::unique_ptr<b2World> world_;
  b2Body* first_ = nullptr;
};

void train(benchmark::State& state) {
  Train train;
  train.cars = static_cast<int>(state.range(0));
  train.mass = 80e3 * train.cars;
  train.speed = 20.0;
  train.track = {Straight{400.0}, Curve{600.0, 30.0, {}, 80.0}};
  DrivePhase pull;
  pull.at = 0.0;
  pull.command = Force{300e3, 0.0};
  train.drive = {pull};
  WorldConfig config;
  config.physics.rate = kRate;
  config.targets = {target_of(train, 0)};
  compare(
      state, train.cars, [&] { return World(config, 1); }, [&] { return BareTrain(train.cars); });
}

/// What the process holds in memory now [MB].
double memory_in_use() {
  std::ifstream file("/proc/self/statm");
  long total = 0;
  long resident = 0;
  file >> total >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Balloons that drift through turbulence and balls that bounce, for ten minutes.
void memory_over_time(benchmark::State& state) {
  WorldConfig config = world_of_balls(flying(20));
  config.environment.ground = Ground{};
  for (int i = 0; i < 20; ++i) {
    Balloon balloon;
    balloon.position = {10.0 * i, 200.0};
    config.targets.push_back(target_of(balloon, 1000 + i));
  }
  config.environment.wind.mean = {8.0, 0.0};
  config.environment.wind.turbulence.model = OrnsteinUhlenbeck{};
  for (auto _ : state) {
    World world(config, 1);
    world.sample(60.0);
    state.counters["MB_after_60_s"] = memory_in_use();
    world.sample(600.0);
    state.counters["MB_after_600_s"] = memory_in_use();
  }
}

/// A second of 10 000 balloons 50 m apart, each in gusts of its own.
void ten_thousand_balloons(benchmark::State& state) {
  Target swarm = target_of(Balloon{}, 0);
  swarm.grid = Grid{100, 100, {50.0, 50.0}};
  WorldConfig config;
  config.physics.rate = kRate;
  config.environment.gravity = 0.0;
  config.environment.wind.mean = {8.0, 0.0};
  config.environment.wind.turbulence.model = OrnsteinUhlenbeck{};
  config.targets = {swarm};
  for (auto _ : state) {
    World world(config, 1);
    world.sample(1.0);
    state.counters["MB"] = memory_in_use();
  }
}

BENCHMARK(flying_balls)
    ->Name("flying_balls")
    ->Arg(1'000)
    ->Arg(10'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(bouncing_balls)->Name("bouncing_balls")->Arg(1'000)->Unit(benchmark::kMillisecond);
BENCHMARK(train)->Name("train")->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(memory_over_time)->Name("memory_over_time")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(ten_thousand_balloons)
    ->Name("ten_thousand_balloons")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ghtrack::bench

#include "sim/regimes/railway.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/portable_math.hpp"
#include "sim/random.hpp"
#include "tests/sim/scenario.hpp"

// Trains that are targets of their own and meet on one track, and those whose tracks cross.

namespace ghtrack {
namespace {

/// The same track, described from its other end.
Train turned_round(Train train, const Vec2& end, double heading_deg) {
  train.position = end;
  train.heading_deg = heading_deg + 180.0;
  std::vector<TrackElement> reversed;
  for (auto element = train.track.rbegin(); element != train.track.rend(); ++element) {
    reversed.push_back(*element);
    if (auto* const curve = std::get_if<Curve>(&reversed.back())) *curve->angle_deg *= -1.0;
  }
  train.track = reversed;
  return train;
}

// Derived: two targets on one track couple as cars `ahead` do: with m₁ v₁ + m₂ v₂ = (m₁ + m₂) v,
// and their springs take ½ (v₁ − v₂)² m₁ m₂ / (m₁ + m₂). The front of the one, at 15 m, meets the
// rear of the other, at 55 m, after 40 m / (v₁ − v₂).
TEST(Railway, CouplesTargetsByMomentum) {
  WorldConfig config = world_of({target_of(free_cars(2, 100e3, 10.0, 3.0), "one"),
                                 target_of(free_cars(3, 60e3, 80.0, 1.0), "other")});
  config.record.events = true;
  World world(config, 1);
  const std::vector<double> masses{100e3, 60e3};
  const double begun = kinetic_energy(world.sample(19.9), masses);
  const TruthSnapshot truth = world.sample(40.0);
  const double common = (300.0 + 60.0) / 160.0;
  for (const TruthState& train : truth.objects) EXPECT_NEAR(train.velocity.x(), common, 1e-6);
  EXPECT_NEAR(begun - kinetic_energy(truth, masses), 0.5 * 4.0 * 100e3 * 60e3 / 160e3, 1.0);
  EXPECT_NEAR(truth.objects[1].position.x() - truth.objects[0].position.x(), 30.0, 1e-4);
  ASSERT_EQ(world.events().size(), 1u);
  EXPECT_EQ(world.events()[0].kind, EventKind::kCoupling);
  EXPECT_NEAR(world.events()[0].time, 20.0, 1e-6);
  EXPECT_EQ(world.events()[0].object, 0);
  EXPECT_EQ(world.events()[0].other, 1);
  EXPECT_LT((world.events()[0].impulse - Vec2(-100e3 * (3.0 - common), 0.0)).norm(), 1e-2);
}

// Derived: without damping and couplings, buffers give all back: v₁' = ((m₁ − m₂) v₁ + 2 m₂ v₂) /
// (m₁
// + m₂), after a contact of π √(μ/k) with μ = m₁ m₂/(m₁ + m₂); the two are driven at each other,
// each on the track as seen from its own end.
TEST(Railway, BuffersElasticallyHeadOn) {
  Train one = free_cars(1, 60e3, 0.0, 1.5);
  one.couplers = Couplers{1e7, 0.0, 0.0};
  one.couples = false;
  Train other = free_cars(1, 20e3, 0.0, 0.5);
  other.couplers = one.couplers;
  other.position = Vec2(30.0, 0.0);
  other.heading_deg = 180.0;
  World world(world_of({target_of(one), target_of(other)}), 1);
  const double contact = portable::kPi * std::sqrt(15e3 / 1e7);
  EXPECT_NEAR(world.sample(10.0 - 1e-3).objects[1].velocity.x(), -0.5, 1e-9);
  const TruthSnapshot middle = world.sample(10.0 + 0.5 * contact);
  EXPECT_NEAR(middle.objects[1].position.x() - middle.objects[0].position.x(),
              10.0 - 2.0 * std::sqrt(15e3 / 1e7), 1e-5);
  // There the spring presses with k times that.
  EXPECT_NEAR(middle.objects[0].acceleration.x(), -2.0 * std::sqrt(15e3 * 1e7) / 60e3, 1e-2);
  const TruthSnapshot after = world.sample(10.0 + contact + 1e-3);
  EXPECT_NEAR(after.objects[0].velocity.x(), (40e3 * 1.5 - 40e3 * 0.5) / 80e3, 1e-5);
  EXPECT_NEAR(after.objects[1].velocity.x(), (120e3 * 1.5 + 40e3 * 0.5) / 80e3, 1e-5);
}

// Derived: on a curve, too, whichever end the track is described from, momentum along it decides,
// and cars keep their distance along it.
TEST(Railway, MeetsOnACurveDescribedFromEitherEnd) {
  Train one = free_cars(1, 100e3, 60.0, 2.0);
  one.track = {Straight{100.0}, Curve{150.0, 60.0, {}, 40.0}, Straight{100.0}};
  const RailLine line(one.track, one.position, 0.0);
  const TrackPoint end = line.at(line.length());
  for (const bool is_turned : {false, true}) {
    Train other = one;
    other.mass = 50e3;
    other.start = 160.0;
    other.speed = 0.0;
    if (is_turned) {
      other = turned_round(other, end.position, end.heading * 180.0 / portable::kPi);
      other.start = line.length() - 160.0;
    }
    World world(seen_from_above({target_of(one), target_of(other)}), 1);
    const TruthSnapshot truth = world.sample(60.0);
    const double common = 200.0 / 150.0;
    for (const TruthState& train : truth.objects) {
      EXPECT_NEAR(train.velocity.norm(), common, 1e-6) << is_turned;
    }
    const double place = 150.0 + 15.0 * common;  // of the first; they touched after 45 s
    EXPECT_LT((truth.objects[0].position - line.at(place).position).norm(), 0.1) << is_turned;
    EXPECT_NEAR((truth.objects[1].position - truth.objects[0].position).norm(), 10.0, 0.01);
  }
}

// Property: trains on one track that nothing drives keep their momentum, lose energy, and stay in
// their order; rigid and sprung, long and short, that couple and that do not.
TEST(Railway, KeepsMomentumAndOrder) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Stream stream(seed, Purpose::kGeneration, key_of("railway"), 0);
    WorldConfig config;
    std::vector<double> masses;
    double place = 0.0;
    const int trains = 2 + static_cast<int>(4.0 * stream.uniform());
    for (int i = 0; i < trains; ++i) {
      const int cars = 1 + static_cast<int>(4.0 * stream.uniform());
      const double mass = 20e3 * cars * std::exp(2.0 * stream.uniform());
      const double speed = 20.0 * (stream.uniform() - 0.5);
      place += 10.0 * cars + 30.0 * stream.uniform();
      Train train = free_cars(cars, mass, place, speed);
      train.track_every_car = true;
      if (stream.uniform() < 0.4) train.couplers = Couplers{1e7, 3e5, 0.01};
      train.couples = stream.uniform() < 0.6;
      if (stream.uniform() < 0.5) {
        train.position = Vec2(500.0, 0.0);
        train.heading_deg = 180.0;
        train.start = 500.0 - place + 10.0 * (cars - 1);
      }
      config.targets.push_back(target_of(train, "train " + std::to_string(i)));
      masses.insert(masses.end(), static_cast<std::size_t>(cars), mass / cars);
    }
    World world(config, seed);
    const auto momentum = [&](const TruthSnapshot& truth) {
      double sum = 0.0;
      for (std::size_t i = 0; i < masses.size(); ++i)
        sum += masses[i] * truth.objects[i].velocity.x();
      return sum;
    };
    const TruthSnapshot begun = world.sample(0.0);
    const double energy = kinetic_energy(begun, masses);
    const TruthSnapshot truth = world.sample(20.0);
    EXPECT_NEAR(momentum(truth), momentum(begun), 1e-3 * std::sqrt(energy)) << seed;
    EXPECT_LE(kinetic_energy(truth, masses), energy * (1.0 + 1e-6)) << seed;
    // The middles of the trains, as they began.
    double before = -1e9;
    std::size_t object = 0;
    for (const Target& target : config.targets) {
      const int cars = std::get<Train>(target.motion).cars;
      double middle = 0.0;
      for (int car = 0; car < cars; ++car) middle += truth.objects[object++].position.x() / cars;
      EXPECT_GT(middle, before + 5.0) << seed;
      before = middle;
    }
  }
}

// Property: trains on one track that do not meet move as each does alone, to the last bit.
TEST(Railway, LeavesAloneWhoMeetsNobody) {
  Train one = free_cars(2, 100e3, 0.0, 12.0);
  one.davis_a = 1e3;
  one.drive = {phase_at(2.0, Brake{}), phase_at(9.0, Accelerate{0.3})};
  Train other = one;
  other.start = 900.0;
  World together(world_of({target_of(one, "one"), target_of(other, "other")}), 1);
  World alone(world_of({target_of(other, "other")}), 1);
  for (int i = 0; i <= 60; ++i) {
    const TruthState expected = alone.sample(0.5 * i).objects[0];
    const TruthState state = together.sample(0.5 * i).objects[1];
    EXPECT_EQ(state.position, expected.position);
    EXPECT_EQ(state.acceleration, expected.acceleration);
  }
}

std::vector<WorldEvent> passages(const WorldConfig& config, double duration) {
  World world(config, 1);
  world.sample(duration);
  std::vector<WorldEvent> found;
  for (const WorldEvent& event : world.events()) {
    if (event.kind == EventKind::kPassage) found.push_back(event);
  }
  return found;
}

// Derived: two trains whose tracks cross at (200, 0) pass through each other when both are there:
// the fronts come to it after 195 m / 20 m/s = 9.75 s. With the one delayed by its length and more,
// or on tracks side by side, nobody does.
TEST(Railway, TellsOfTrainsWhoseTracksCross) {
  const Train one = free_cars(2, 100e3, 0.0, 20.0);
  Train crossing = one;
  crossing.position = Vec2(200.0, -200.0);
  crossing.heading_deg = 90.0;
  const auto found = passages(world_of({target_of(one), target_of(crossing)}), 30.0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].object, 0);
  EXPECT_EQ(found[0].other, 1);
  EXPECT_NEAR(found[0].time, 9.75, 0.1);
  EXPECT_LT((found[0].position - Vec2(200.0, 0.0)).norm(), 10.0);
  crossing.start = -30.0;
  EXPECT_TRUE(passages(world_of({target_of(one), target_of(crossing)}), 30.0).empty());
  Train beside = one;
  beside.position = Vec2(300.0, 0.8);
  beside.heading_deg = 180.0;
  EXPECT_TRUE(passages(world_of({target_of(one), target_of(beside)}), 30.0).empty());
}

// Property: tracks that are one in part only are told of, and so are trains that begin inside each
// other; these run on as if alone, and meet what they meet from outside.
TEST(Railway, TellsOfTracksThatAreOneInPartAndOfTrainsInsideEachOther) {
  Train one = free_cars(2, 100e3, 0.0, 20.0);
  Train other = one;
  other.start = 100.0;
  other.speed = 0.0;
  other.track = {Straight{300.0}, Curve{300.0, 20.0, {}, 0.0}};
  auto found = passages(world_of({target_of(one), target_of(other)}), 30.0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].time, 80.0 / 20.0, 0.1);

  Train inside = one;
  inside.start = 5.0;
  inside.speed = 25.0;
  Train ahead = one;
  ahead.start = 200.0;
  ahead.speed = 0.0;
  const WorldConfig config = world_of({target_of(one), target_of(inside), target_of(ahead)});
  found = passages(config, 5.0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].object, 0);
  EXPECT_EQ(found[0].other, 1);
  World world(config, 1);
  EXPECT_EQ(world.sample(5.0).objects[1].velocity.x(), 25.0);
  // All three hang together in the end.
  const TruthSnapshot truth = world.sample(60.0);
  for (const TruthState& train : truth.objects) EXPECT_NEAR(train.velocity.x(), 15.0, 1e-6);
}

// Derived: lines that are one curve, by their places on each other.
TEST(Railway, FindsWhichLinesAreOne) {
  const std::vector<TrackElement> bend{Straight{50.0}, Curve{200.0, 30.0, {}, 0.0}};
  const RailLine line(bend, Vec2(1e4, -3e3), 0.3);
  const TrackPoint ahead = line.at(-40.0);
  const std::vector<TrackElement> longer{Straight{90.0}, bend[1], Straight{10.0}};
  const auto place = place_on(RailLine(longer, ahead.position, ahead.heading), line);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->begin, -40.0, 1e-9);
  EXPECT_EQ(place->direction, 1.0);
  EXPECT_FALSE(place_on(RailLine({Straight{90.0}}, ahead.position, ahead.heading), line));
  EXPECT_FALSE(place_on(RailLine(bend, Vec2(1e4, -3e3 + 0.01), 0.3), line));
  const RailLine straight({}, Vec2(0.0, 1.0), 0.0);
  const auto against =
      place_on(RailLine({Straight{9.0}}, Vec2(70.0, 1.0), portable::kPi), straight);
  ASSERT_TRUE(against);
  EXPECT_NEAR(against->begin, 70.0, 1e-9);
  EXPECT_EQ(against->direction, -1.0);
  EXPECT_FALSE(place_on(RailLine({}, Vec2(0.0, 1.1), 0.0), straight));
  EXPECT_FALSE(place_on(RailLine({}, Vec2(0.0, 1.0), 1e-3), straight));
}

}  // namespace
}  // namespace ghtrack

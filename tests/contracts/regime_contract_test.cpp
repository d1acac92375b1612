#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenes/schema/field.hpp"
#include "sim/world.hpp"

namespace ghtrack {
namespace {

/// Collects what a described configuration says of its keys.
struct KeyList {
  std::vector<std::string> keys;
  std::vector<std::string> faults;

  void add(std::string_view key, const schema::FieldInfo& info) {
    keys.emplace_back(key);
    if (info.meaning.empty()) faults.push_back(keys.back() + " has no meaning");
  }
  template <class S, class T>
  void field(std::string_view key, T S::*, const schema::FieldInfo& info) {
    add(key, info);
    const bool is_number = std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>;
    if (is_number && info.unit.empty()) faults.push_back(keys.back() + " has no unit");
    if (is_number &&
        (std::max(info.minimum, info.above) < -1e9 || std::min(info.maximum, info.below) > 1e9)) {
      faults.push_back(keys.back() + " has no bounds");
    }
  }
  template <class S, class T, class Range>
  void preset(std::string_view key, T S::*member, const Range& rows,
              const schema::FieldInfo& info) {
    add(key, info);
    if (rows.empty()) faults.push_back(keys.back() + " has no rows");
    if (!rows.empty() && rows[0].*member != S{}.*member) {
      faults.push_back(keys.back() + ": the first row must be the default");
    }
  }
};

template <class R>
class RegimeContract : public ::testing::Test {};

template <class Variant>
struct AsTypes;
template <class... R>
struct AsTypes<std::variant<R...>> {
  using Types = testing::Types<R...>;
};
TYPED_TEST_SUITE(RegimeContract, AsTypes<Regime>::Types);

WorldConfig world_of(const Regime& motion) {
  WorldConfig world;
  world.targets.emplace_back();
  world.targets[0].motion = motion;
  world.environment.wind.mean = Vec2(3.0, 0.0);
  return world;
}

/// Any motion but standing still.
template <class R>
R moving() {
  R regime;
  if constexpr (requires { regime.speed = 12.0; }) regime.speed = 12.0;
  if constexpr (requires { regime.rate_deg = 30.0; }) regime.rate_deg = 30.0;
  if constexpr (requires { regime.legs; }) {
    regime.legs.emplace_back().course = Turn{.angle_deg = 3600.0, .radius = 40.0};
  }
  if constexpr (requires { regime.places; }) {
    regime.places = {{0.0, 0.0, 0.0}, {1.0, 4.0, 1.0}, {2.0, 7.0, 4.0}, {3.0, 8.0, 8.0}};
  }
  if constexpr (requires { regime.plan; }) regime.plan = {{0.0, KeepVelocity{Vec2(5.0, 2.0)}}};
  return regime;
}

// Property: every key is documented, has a unit if it is a number, and bounds that keep the
// equations of motion finite.
TYPED_TEST(RegimeContract, DescribesEveryKey) {
  KeyList list;
  TypeParam::describe(list);
  EXPECT_FALSE(list.keys.empty());
  for (const std::string& fault : list.faults) ADD_FAILURE() << TypeParam::kind << ": " << fault;
  EXPECT_FALSE(std::string_view(TypeParam::about).empty());
}

// Property: the defaults make a world that moves.
TYPED_TEST(RegimeContract, MovesByDefault) {
  World world(world_of(moving<TypeParam>()), 1);
  ASSERT_EQ(world.objects().size(), 1u);
  EXPECT_EQ(world.objects()[0].regime, TypeParam::kind);
  const Vec2 start = world.sample(0.0).objects.at(0).position;
  EXPECT_GT((world.sample(2.0).objects.at(0).position - start).norm(), 1.0);
}

// Property: velocity is the derivative of position and acceleration that of velocity.
TYPED_TEST(RegimeContract, ReportsConsistentDerivatives) {
  WorldConfig config = world_of(moving<TypeParam>());
  World world(config, 1);
  constexpr double kHalf = 1e-3;
  for (const double time : {0.5, 1.2, 1.9}) {
    const TruthState before = world.sample(time - kHalf).objects.at(0);
    const TruthState now = world.sample(time).objects.at(0);
    const TruthState after = world.sample(time + kHalf).objects.at(0);
    EXPECT_LT(((after.position - before.position) / (2.0 * kHalf) - now.velocity).norm(), 1e-3);
    EXPECT_LT(((after.velocity - before.velocity) / (2.0 * kHalf) - now.acceleration).norm(), 1e-2);
  }
}

// Property: what is shifted moves as it would elsewhere; what is hastened begins with another
// velocity, along the one that it has at least: a track, a rod or a route lets it change no other.
TYPED_TEST(RegimeContract, CanBeShiftedAndHastened) {
  const TypeParam regime = moving<TypeParam>();
  const Vec2 by(30.0, 20.0);
  TypeParam shifted = regime;
  shifted.shift(by);
  World here(world_of(regime), 1);
  World there(world_of(shifted), 1);
  const TruthState begin = here.sample(0.0).objects.at(0);
  const double speed = begin.velocity.norm();
  const Vec2 faster = speed > 0.0 ? Vec2(2.0 / speed * begin.velocity) : Vec2(2.0, 0.0);
  TypeParam hastened = regime;
  hastened.hasten(faster);
  World hurried(world_of(hastened), 1);
  const Vec2 velocity = hurried.sample(0.0).objects.at(0).velocity;
  EXPECT_LT((velocity - begin.velocity - faster).norm(), 1e-12);
  for (const double time : {0.0, 1.0, 3.0}) {
    const Vec2 apart =
        there.sample(time).objects.at(0).position - here.sample(time).objects.at(0).position;
    EXPECT_LT((apart - by).norm(), 1e-9);
  }
}

// Property: an object looks like something.
TYPED_TEST(RegimeContract, HasAnOutlineAndBodies) {
  World world(world_of(moving<TypeParam>()), 1);
  EXPECT_GT(world.objects()[0].outline.length, 0.0);
  EXPECT_GT(world.objects()[0].outline.width, 0.0);
  EXPECT_FALSE(world.sample(0.0).bodies.empty());
}

}  // namespace
}  // namespace ghtrack

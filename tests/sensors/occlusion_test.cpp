#include "sensors/occlusion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

using portable::kPi;

ObjectInfo object(ObjectId id, const std::string& name, const Outline& outline) {
  return {.id = id, .name = name, .regime = "", .label = "", .key = 0, .outline = outline};
}

TruthSnapshot bodies(const std::vector<BodyPose>& poses) {
  return {.time = 0.0, .objects = {}, .bodies = poses};
}

const Outline kSquare{.shape = Outline::Shape::kBox, .length = 2.0, .width = 2.0};
const Outline kDisc{.shape = Outline::Shape::kDisc, .length = 2.0, .width = 0.0};

constexpr double kSamplingError = 0.015;  // 500 points

// Derived: a square shifted by half its side covers half of the one behind it.
TEST(Occlusion, MeasuresTheCoveredFractionOfABox) {
  const std::vector<ObjectInfo> objects = {object(0, "a", kSquare), object(1, "b", kSquare)};
  const auto covered =
      covered_fractions(bodies({{0, Vec2(0, 0), 0.0}, {1, Vec2(1, 0), 0.0}}), objects, {});
  EXPECT_NEAR(covered[0], 0.5, kSamplingError);
  EXPECT_EQ(covered[1], 0.0);
}

// Derived: a square turned by 45° inside its disc covers 2 / π of it.
TEST(Occlusion, TurnsBoxesWithTheirHeading) {
  const Outline inner{
      .shape = Outline::Shape::kBox, .length = std::sqrt(2.0), .width = std::sqrt(2.0)};
  const std::vector<ObjectInfo> objects = {object(0, "ball", kDisc), object(1, "box", inner)};
  const auto covered =
      covered_fractions(bodies({{0, Vec2(5, 5), 0.0}, {1, Vec2(5, 5), 0.25 * kPi}}), objects, {});
  EXPECT_NEAR(covered[0], 2.0 / kPi, kSamplingError);
}

// Derived: two discs of radius 1 at distance 1 share 2π/3 − √3/2.
TEST(Occlusion, MeasuresTheLensOfTwoDiscs) {
  const std::vector<ObjectInfo> objects = {object(0, "a", kDisc), object(1, "b", kDisc)};
  const auto covered =
      covered_fractions(bodies({{0, Vec2(0, 0), 0.0}, {1, Vec2(0, 1), 0.0}}), objects, {});
  EXPECT_NEAR(covered[0], (2.0 * kPi / 3.0 - 0.5 * std::sqrt(3.0)) / kPi, kSamplingError);
}

// Derived: the named ones are in front in their order, a name standing for all cars of a train; the
// others follow from the last to the first.
TEST(Occlusion, ObeysTheGivenOrder) {
  const std::vector<ObjectInfo> objects = {object(0, "train", kSquare),
                                           object(1, "train car 2", kSquare),
                                           object(2, "a", kSquare), object(3, "b", kSquare)};
  const TruthSnapshot truth = bodies(
      {{0, Vec2(0, 0), 0.0}, {1, Vec2(10, 0), 0.0}, {2, Vec2(10, 0), 0.0}, {3, Vec2(0, 0), 0.0}});
  EXPECT_EQ(covered_fractions(truth, objects, {}), (std::vector<double>{1, 1, 0, 0}));
  EXPECT_EQ(covered_fractions(truth, objects, {"train"}), (std::vector<double>{0, 0, 1, 1}));
  EXPECT_EQ(covered_fractions(truth, objects, {"b", "train"}), (std::vector<double>{1, 0, 1, 0}));
}

// Derived: two covers of one half each, side by side, hide everything; their overlap counts once.
TEST(Occlusion, CountsOverlappingCoversOnce) {
  const std::vector<ObjectInfo> objects = {object(0, "a", kSquare), object(1, "b", kSquare),
                                           object(2, "c", kSquare)};
  const auto both = covered_fractions(
      bodies({{0, Vec2(0, 0), 0.0}, {1, Vec2(1, 0), 0.0}, {2, Vec2(-1, 0), 0.0}}), objects, {});
  EXPECT_NEAR(both[0], 1.0, kSamplingError);
  const auto same = covered_fractions(
      bodies({{0, Vec2(0, 0), 0.0}, {1, Vec2(1, 0), 0.0}, {2, Vec2(1, 0), 0.0}}), objects, {});
  EXPECT_NEAR(same[0], 0.5, kSamplingError);
}

}  // namespace
}  // namespace ghtrack

#include "sensors/merging.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ghtrack {
namespace {

Sighting sighting(double x, ObjectId origin, const std::string& label = "") {
  return {.detection = {.position = Vec2(x, 0.0),
                        .covariance = (1.0 + x) * Eigen::Matrix2d::Identity(),
                        .label = label},
          .origin = origin};
}

// Derived: two within the resolution become one at their mean, one outside stays.
TEST(Merging, JoinsWhatLiesCloserThanTheResolution) {
  auto merged =
      merge_close({sighting(0.0, 0, "ball"), sighting(1.0, 1, "train"), sighting(3.0, 2)}, 1.5);
  ASSERT_EQ(merged.size(), 2);
  std::sort(merged.begin(), merged.end(),
            [](const auto& a, const auto& b) { return a.origin < b.origin; });
  EXPECT_EQ(merged[0].detection.position, Vec2(0.5, 0.0));
  EXPECT_EQ(merged[0].detection.covariance(0, 0), 1.5);
  EXPECT_EQ(merged[0].origin, 0);
  EXPECT_EQ(merged[0].detection.label, "ball");
  EXPECT_EQ(merged[1].origin, 2);
}

// Derived: a chain of close steps is one detection; the object nearest to the mean gives its name.
TEST(Merging, FollowsChains) {
  const auto merged =
      merge_close({sighting(0.0, 0), sighting(1.0, 1), sighting(2.0, 2), sighting(3.3, 3)}, 1.4);
  ASSERT_EQ(merged.size(), 1);
  EXPECT_NEAR(merged[0].detection.position.x(), 1.575, 1e-12);
  EXPECT_EQ(merged[0].origin, 2);
}

// Derived: an object together with nearer clutter is the object's detection.
TEST(Merging, PrefersObjectsToClutter) {
  const auto merged = merge_close(
      {sighting(0.0, 4), sighting(1.0, kClutterOrigin), sighting(1.1, kClutterOrigin)}, 2.0);
  ASSERT_EQ(merged.size(), 1);
  EXPECT_EQ(merged[0].origin, 4);
}

// Property: the result does not depend on the order of the detections.
TEST(Merging, DoesNotDependOnTheOrder) {
  const std::vector<Sighting> forwards = {sighting(0.0, 0), sighting(0.9, 1), sighting(2.5, 2)};
  const std::vector<Sighting> backwards(forwards.rbegin(), forwards.rend());
  const auto a = merge_close(forwards, 1.0);
  const auto b = merge_close(backwards, 1.0);
  ASSERT_EQ(a.size(), 2);
  ASSERT_EQ(b.size(), 2);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].origin, b[i].origin);
    EXPECT_EQ(a[i].detection.position, b[i].detection.position);
  }
}

}  // namespace
}  // namespace ghtrack

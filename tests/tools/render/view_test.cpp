#include "tools/render/view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ghtrack::render {
namespace {

// Derived: 100 m on 1000 px are 10 px a metre; y points up.
TEST(View, MapsTheWorldWithOneScaleAndYUp) {
  const View view({Vec2(0.0, 0.0), Vec2(100.0, 20.0)}, {0.0, 50.0, 1000.0, 600.0});
  EXPECT_DOUBLE_EQ(view.scale(), 10.0);
  EXPECT_DOUBLE_EQ(view.to_pixel({0.0, 10.0}).x, 0.0);
  EXPECT_DOUBLE_EQ(view.to_pixel({0.0, 10.0}).y, 350.0);
  EXPECT_DOUBLE_EQ(view.to_pixel({100.0, 20.0}).x, 1000.0);
  EXPECT_DOUBLE_EQ(view.to_pixel({100.0, 20.0}).y, 250.0);
}

// Property: to_world inverts to_pixel, and the whole rectangle is inside the viewport.
TEST(View, IsInvertibleAndShowsTheWholeRectangle) {
  const Rectangle world{Vec2(-37.0, 12.0), Vec2(140.0, 260.0)};
  const View view(world, {10.0, 20.0, 640.0, 480.0});
  for (const Vec2& point : {world.min, world.max, Vec2(3.0, 77.0)})
    EXPECT_LT((view.to_world(view.to_pixel(point)) - point).norm(), 1e-9);
  EXPECT_TRUE((view.world().min.array() <= world.min.array() + 1e-9).all());
  EXPECT_TRUE((view.world().max.array() >= world.max.array() - 1e-9).all());
}

// Property: no rectangle makes a scale that is not a positive number.
TEST(View, HasAScaleForEveryRectangle) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const Rectangle& world :
       {Rectangle{Vec2(0, 0), Vec2(0, 0)}, Rectangle{Vec2(5, 5), Vec2(-5, -5)},
        Rectangle{Vec2(nan, 0), Vec2(1, nan)}, Rectangle{Vec2(-inf, -1e300), Vec2(inf, 1e300)}}) {
    const View view(world, {0.0, 0.0, 1280.0, 720.0});
    EXPECT_TRUE(std::isfinite(view.scale()) && view.scale() > 0.0);
    EXPECT_TRUE(std::isfinite(view.to_pixel({1.0, 2.0}).x));
  }
}

// Property: the bounds hold all finite points and the margin, and ignore the rest.
TEST(View, BoundsFinitePointsOnly) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(bounding_rectangle({Vec2(nan, 0.0)}).has_value());
  const auto bounds = bounding_rectangle({Vec2(0, 0), Vec2(nan, 9e9), Vec2(10, 4)}, 0.1);
  ASSERT_TRUE(bounds.has_value());
  EXPECT_DOUBLE_EQ(bounds->min.x(), -1.0);
  EXPECT_DOUBLE_EQ(bounds->max.y(), 5.0);
}

}  // namespace
}  // namespace ghtrack::render

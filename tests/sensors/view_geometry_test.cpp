#include "sensors/view_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sensors/radar.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

const Quadrilateral kKite{{Vec2(0, 0), Vec2(4, 1), Vec2(6, 6), Vec2(1, 3)}};

FieldOfView sector() {
  Radar radar;
  radar.max_range = 10.0;
  radar.sector_deg = Vec2(-60.0, 60.0);
  return radar.view(Vec2(1, 1));
}

/// How many of n points of the view lie in the part.
template <class Part>
int count_in(const FieldOfView& view, int n, Part part) {
  Stream stream(1, Purpose::kClutter, 0, 0);
  int inside = 0;
  for (int i = 0; i < n; ++i) {
    const double u = stream.uniform();
    const double v = stream.uniform();
    const Vec2 point = point_in(view, u, v);
    EXPECT_TRUE(contains(view, point)) << point.transpose();
    inside += part(point);
  }
  return inside;
}

// Derived: points fall into a part as often as its share of the area, within 4.5 standard errors.
TEST(ViewGeometry, SpreadsPointsEvenly) {
  constexpr int kPoints = 20000;
  const auto expect_share = [](int count, double share) {
    EXPECT_NEAR(count, share * kPoints, 4.5 * std::sqrt(kPoints * share * (1.0 - share)));
  };
  // The inner half radius holds a quarter of a sector, its upper part one half.
  expect_share(
      count_in(sector(), kPoints, [](const Vec2& p) { return (p - Vec2(1, 1)).norm() < 5; }), 0.25);
  expect_share(count_in(sector(), kPoints, [](const Vec2& p) { return p.y() > 1; }), 0.5);
  // The triangle (0,0) (4,1) (6,6) has twice the area 18, (0,0) (6,6) (1,3) has 12.
  expect_share(count_in(kKite, kPoints, [](const Vec2& p) { return p.x() > p.y(); }), 0.6);
  // The line y = 2x through (0,0) cuts a seventh off the second, at (1,3).
  expect_share(count_in(kKite, kPoints, [](const Vec2& p) { return p.y() > 2.0 * p.x(); }),
               12.0 / 30.0 / 7.0);
}

// Property: the corners of the outline lie on the edge of what is seen.
TEST(ViewGeometry, DrawsTheEdgeOfASector) {
  const auto corners = outline_of(sector());
  ASSERT_GT(corners.size(), 30U);
  EXPECT_EQ(corners.front(), Vec2(1, 1));
  for (std::size_t i = 1; i < corners.size(); ++i) {
    EXPECT_NEAR((corners[i] - Vec2(1, 1)).norm(), 10.0, 1e-9);
  }
  EXPECT_TRUE(outline_of(Everywhere{}).empty());
  EXPECT_EQ(outline_of(Eigen::AlignedBox2d(Vec2(0, 0), Vec2(2, 1))).size(), 4U);
}

}  // namespace
}  // namespace ghtrack

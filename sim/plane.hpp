#pragma once

#include <Eigen/Core>

#include "sim/portable_math.hpp"

/// Vectors of the vertical or horizontal plane in which everything moves, x right and y up or left.
namespace ghtrack {

using Vec2 = Eigen::Vector2d;

/// The unit vector at an angle from the x axis [rad], counter-clockwise.
inline Vec2 direction(double angle) {
  const portable::SinCos there = portable::sin_cos(angle);
  return {there.cos, there.sin};
}

/// A vector turned counter-clockwise by 90°.
inline Vec2 left_of(const Vec2& v) { return {-v.y(), v.x()}; }

/// |a| |b| sin of the angle from a to b: positive where b points to the left of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace ghtrack

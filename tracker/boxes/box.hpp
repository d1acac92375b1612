#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace ghtrack {

/// A rectangle around an object in an image, x right, y down [pixel].
struct BoundingBox {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Ones();  // width and height, > 0

  double area() const { return size.x() * size.y(); }
  Eigen::Vector2d low() const { return centre - 0.5 * size; }
  Eigen::Vector2d high() const { return centre + 0.5 * size; }
};

/// Area of the intersection over area of the union, 0 … 1.
inline double intersection_over_union(const BoundingBox& a, const BoundingBox& b) {
  const Eigen::Vector2d common = a.high().cwiseMin(b.high()) - a.low().cwiseMax(b.low());
  if (!(common.x() > 0.0) || !(common.y() > 0.0)) return 0.0;
  const double intersection = common.x() * common.y();
  return intersection / (a.area() + b.area() - intersection);
}

/// The box a fraction of the way from one to another.
inline BoundingBox between(const BoundingBox& from, const BoundingBox& to, double fraction) {
  return {from.centre + fraction * (to.centre - from.centre),
          from.size + fraction * (to.size - from.size)};
}

}  // namespace ghtrack

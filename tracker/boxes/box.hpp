#pragma once

#include <Eigen/Core>

namespace ghtrack {

/// A rectangle around an object in an image, x right, y down [pixel].
struct BoundingBox {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Ones();  // width and height, > 0

  double area() const { return size.x() * size.y(); }
  Eigen::Vector2d top_left() const { return centre - 0.5 * size; }
};

/// The box a fraction of the way from one to another.
inline BoundingBox between(const BoundingBox& from, const BoundingBox& to, double fraction) {
  return {from.centre + fraction * (to.centre - from.centre),
          from.size + fraction * (to.size - from.size)};
}

}  // namespace ghtrack

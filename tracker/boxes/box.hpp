#pragma once

#include <Eigen/Core>
#include <algorithm>

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

/// Intersection over union, 0 … 1.
inline double overlap(const BoundingBox& a, const BoundingBox& b) {
  const auto shared = [&](int axis) {
    const double low =
        std::max(a.centre[axis] - 0.5 * a.size[axis], b.centre[axis] - 0.5 * b.size[axis]);
    const double high =
        std::min(a.centre[axis] + 0.5 * a.size[axis], b.centre[axis] + 0.5 * b.size[axis]);
    return std::max(0.0, high - low);
  };
  const double both = shared(0) * shared(1);
  return both > 0.0 ? both / (a.area() + b.area() - both) : 0.0;
}

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <variant>
#include <vector>

namespace ghtrack {

/// Sees everything.
struct Everywhere {};

/// Sees up to a range, all around or between two bearings.
struct Sector {
  Eigen::Vector2d site = Eigen::Vector2d::Zero();   // world frame [m]
  double max_range = 0.0;                           // [m]
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();  // unit vector to its middle
  double half_width = 3.141592653589793;            // bearings on either side of the axis [rad]
  double cos_half_width = -1.0;

  bool contains(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d offset = p - site;
    const double range = offset.norm();
    return range <= max_range && offset.dot(axis) >= range * cos_half_width;
  }
};

/// A convex quadrilateral, such as what a tilted camera sees of a plane.
struct Quadrilateral {
  std::array<Eigen::Vector2d, 4> corners;  // counter-clockwise, world frame [m]

  bool contains(const Eigen::Vector2d& p) const {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
      const Eigen::Vector2d offset = p - corners[i];
      if (side.x() * offset.y() - side.y() * offset.x() < 0.0) return false;
    }
    return true;
  }
};

/// Where a sensor sees, world frame.
using FieldOfView = std::variant<Everywhere, Eigen::AlignedBox2d, Sector, Quadrilateral>;

inline bool contains(const FieldOfView& view, const Eigen::Vector2d& position) {
  return std::visit(
      [&](const auto& shape) {
        if constexpr (std::is_same_v<decltype(shape), const Everywhere&>)
          return true;
        else
          return shape.contains(position);
      },
      view);
}

/// Area [m²]; infinite for one that sees everything.
inline double area(const FieldOfView& view) {
  struct Area {
    double operator()(const Everywhere&) const { return std::numeric_limits<double>::infinity(); }
    double operator()(const Eigen::AlignedBox2d& box) const { return box.volume(); }
    double operator()(const Sector& sector) const {
      return sector.half_width * sector.max_range * sector.max_range;
    }
    double operator()(const Quadrilateral& shape) const {
      const Eigen::Vector2d a = shape.corners[2] - shape.corners[0];
      const Eigen::Vector2d b = shape.corners[3] - shape.corners[1];
      return 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
    }
  };
  return std::visit(Area{}, view);
}

/// The rectangle between two corners as a scene writes them, lower left first [m]; everywhere
/// unless there are two.
inline FieldOfView rectangle_between(const std::vector<Eigen::Vector2d>& corners) {
  if (corners.size() != 2) return Everywhere{};
  return Eigen::AlignedBox2d(corners[0], corners[1]);
}

/// Reports a `field_of_view` that is neither empty nor a rectangle.
template <class Report>
void check_field_of_view(const std::vector<Eigen::Vector2d>& corners, Report&& report) {
  if (corners.size() == 1) {
    report("field_of_view", "two corners are needed: [[left, bottom], [right, top]]");
  }
  if (corners.size() == 2 && !(corners[0].array() < corners[1].array()).all()) {
    report("field_of_view", "the first corner must lie left of and below the second");
  }
}

}  // namespace ghtrack

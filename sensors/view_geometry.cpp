#include "sensors/view_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace ghtrack {
namespace {

using Eigen::Vector2d;

double twice_area(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

struct PointIn {
  double u, v;

  Vector2d operator()(const Everywhere&) const { return Vector2d::Zero(); }
  Vector2d operator()(const Eigen::AlignedBox2d& box) const {
    return box.min() + Vector2d(u, v).cwiseProduct(box.sizes());
  }
  Vector2d operator()(const Sector& sector) const {
    const double range = sector.max_range * std::sqrt(u);
    return sector.site + range * turned(sector.axis, (2.0 * v - 1.0) * sector.half_width);
  }
  /// u chooses one of the two triangles in proportion to their areas, and a place in it with v.
  Vector2d operator()(const Quadrilateral& view) const {
    const auto& [a, b, c, d] = view.corners;
    const double first = twice_area(a, b, c);
    const double share = first / (first + twice_area(a, c, d));
    const bool in_first = u < share;
    const double along = std::sqrt(in_first ? u / share : (u - share) / (1.0 - share));
    return in_first ? a + along * ((b - a) + v * (c - b)) : a + along * ((c - a) + v * (d - c));
  }
};

struct OutlineOf {
  std::vector<Vector2d> operator()(const Everywhere&) const { return {}; }
  std::vector<Vector2d> operator()(const Eigen::AlignedBox2d& box) const {
    return {box.min(), {box.max().x(), box.min().y()}, box.max(), {box.min().x(), box.max().y()}};
  }
  std::vector<Vector2d> operator()(const Sector& sector) const {
    constexpr double kDegreesPerSide = 3.0;
    const double width = 2.0 * sector.half_width;
    const int sides =
        std::max(2, static_cast<int>(std::ceil(width * 180.0 / portable::kPi / kDegreesPerSide)));
    std::vector<Vector2d> corners;
    if (sector.cos_half_width > -1.0) corners.push_back(sector.site);
    for (int i = 0; i <= sides; ++i) {
      const double angle = width * i / sides - sector.half_width;
      corners.push_back(sector.site + sector.max_range * turned(sector.axis, angle));
    }
    return corners;
  }
  std::vector<Vector2d> operator()(const Quadrilateral& view) const {
    return {view.corners.begin(), view.corners.end()};
  }
};

}  // namespace

Vector2d turned(const Vector2d& vector, double angle) {
  const portable::SinCos turn = portable::sin_cos(angle);
  return {turn.cos * vector.x() - turn.sin * vector.y(),
          turn.sin * vector.x() + turn.cos * vector.y()};
}

Vector2d point_in(const FieldOfView& view, double u, double v) {
  return std::visit(PointIn{u, v}, view);
}

std::vector<Vector2d> outline_of(const FieldOfView& view) { return std::visit(OutlineOf{}, view); }

}  // namespace ghtrack

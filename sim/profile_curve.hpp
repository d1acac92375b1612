#pragma once

#include <vector>

#include "sim/truth.hpp"

namespace ghtrack {

/// A smooth line of ground through points from left to right: the cubic spline whose slope is zero
/// at both ends, where level ground begins. Height, slope and curvature are continuous inside.
class ProfileCurve {
 public:
  /// @param points  at least two, with ascending x [m]
  explicit ProfileCurve(const std::vector<Vec2>& points);

  double height_at(double x) const;

  /// The point of the curve that is nearest to a point, as the centre of a round body sees it.
  struct Nearest {
    Vec2 normal;       // of the curve, away from the ground
    double distance;   // of the point [m]; negative below the ground
    double curvature;  // of the line of points at that distance, positive over a crest [1/m]
  };
  Nearest nearest(const Vec2& point) const;

 private:
  struct Shape {
    double height;
    double slope;
    double bend;  // second derivative
  };
  Shape at(double x) const;

  std::vector<Vec2> points_;
  std::vector<double> bends_;  // second derivatives at the points [1/m]
};

}  // namespace ghtrack

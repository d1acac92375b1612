#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace ghtrack::cli {

/// A point of the ground and the pixel that shows it.
struct GroundPoint {
  Eigen::Vector2d ground;  // [m], or latitude and longitude [°]
  Eigen::Vector2d pixel;
};

/// Reads "X,Y=U,V" each.
/// @throws UsageError unless there are four
std::array<GroundPoint, 4> parse_ground_points(const std::vector<std::string>& texts);

/// The map from a plane to a picture of it that these points determine (Hartley & Zisserman,
/// Multiple View Geometry, ch. 2): u = (h₁ · p) / (h₃ · p), v = (h₂ · p) / (h₃ · p), p = (x, y, 1).
/// @throws UsageError if three of the points are on a line
Eigen::Matrix3d homography(const std::array<GroundPoint, 4>& points);

/// Where a point of the plane is in the picture; NaN if it lies behind the camera.
Eigen::Vector2d projected(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point);

}  // namespace ghtrack::cli

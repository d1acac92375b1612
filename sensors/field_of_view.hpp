#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace ghtrack {

/// The rectangle between two corners as a scene writes them, lower left first [m]; absent unless
/// there are two.
inline std::optional<Eigen::AlignedBox2d> box_between(const std::vector<Eigen::Vector2d>& corners) {
  if (corners.size() != 2) return std::nullopt;
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

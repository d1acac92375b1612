#pragma once

#include <vector>

#include "sensors/field_of_view.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {

/// A vector turned by an angle [rad], counter-clockwise.
Eigen::Vector2d turned(const Eigen::Vector2d& vector, double angle);

/// A point of a field of view, spread evenly over its area as u and v are over [0, 1); the origin
/// if it sees everything [m].
Eigen::Vector2d point_in(const FieldOfView& view, double u, double v);

/// The edge of a field of view as a polygon, counter-clockwise; empty if it sees everything [m].
std::vector<Eigen::Vector2d> outline_of(const FieldOfView& view);

}  // namespace ghtrack

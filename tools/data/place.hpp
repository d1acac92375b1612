#pragma once

#include <Eigen/Core>
#include <optional>

namespace ghtrack {

/// A point of the earth [°], WGS 84.
struct GeoPoint {
  double latitude = 0.0;   // −90 … 90
  double longitude = 0.0;  // −180 … 360
};

/// Local metres around an origin, x east and y north: the azimuthal equidistant projection, in
/// which distance and direction from the origin are true. Other lengths are off by about r²/(6 R²)
/// at a distance r: 0.4 mm in a kilometre 10 km away.
Eigen::Vector2d to_metres(const GeoPoint& origin, const GeoPoint& point);

/// The way back.
GeoPoint to_degrees(const GeoPoint& origin, const Eigen::Vector2d& position);

/// Whether latitude and longitude are in their ranges.
bool is_on_earth(const GeoPoint& point);

}  // namespace ghtrack

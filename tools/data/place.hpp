#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

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

/// The unit vector at a bearing [°], counter-clockwise from x; exact along the axes.
Eigen::Vector2d direction_at(double bearing);

/// The degrees of `49°52'21.9"N`, `N 49 52.365`, `49d52m21.9s` and the like; absent if the text is
/// anything else, or says east or west of a latitude.
std::optional<double> parse_degrees(std::string_view text, bool is_latitude);

/// The place in one cell: `51.47,-0.45`, latitude first, also between brackets, or the well-known
/// text `POINT
/// (-0.45 51.47)`, which has the longitude first. Absent if the text is anything else.
std::optional<GeoPoint> parse_place(std::string_view text);

/// Whether latitude and longitude are in their ranges.
bool is_on_earth(const GeoPoint& point);

}  // namespace ghtrack

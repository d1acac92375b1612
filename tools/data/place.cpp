#include "tools/data/place.hpp"

#include <GeographicLib/AzimuthalEquidistant.hpp>
#include <cmath>

namespace ghtrack {

Eigen::Vector2d to_metres(const GeoPoint& origin, const GeoPoint& point) {
  static const GeographicLib::AzimuthalEquidistant projection;
  Eigen::Vector2d position;
  projection.Forward(origin.latitude, origin.longitude, point.latitude, point.longitude,
                     position.x(), position.y());
  return position;
}

GeoPoint to_degrees(const GeoPoint& origin, const Eigen::Vector2d& position) {
  static const GeographicLib::AzimuthalEquidistant projection;
  GeoPoint point;
  projection.Reverse(origin.latitude, origin.longitude, position.x(), position.y(),
                     point.latitude, point.longitude);
  return point;
}

bool is_on_earth(const GeoPoint& point) {
  return std::abs(point.latitude) <= 90.0 && point.longitude >= -180.0 &&
         point.longitude <= 360.0;
}

}  // namespace ghtrack

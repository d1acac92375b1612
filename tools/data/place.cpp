#include "tools/data/place.hpp"

#include <GeographicLib/AzimuthalEquidistant.hpp>
#include <GeographicLib/DMS.hpp>
#include <cmath>
#include <string>

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

std::optional<double> parse_degrees(std::string_view text, bool is_latitude) {
  using GeographicLib::DMS;
  if (text.find_first_of("0123456789") == std::string_view::npos) return std::nullopt;
  try {
    DMS::flag direction = DMS::NONE;
    const double degrees = DMS::Decode(std::string(text), direction);
    const DMS::flag other = is_latitude ? DMS::LONGITUDE : DMS::LATITUDE;
    if (direction == other || !std::isfinite(degrees)) return std::nullopt;
    return degrees;
  } catch (const GeographicLib::GeographicErr&) {
    return std::nullopt;
  }
}

bool is_on_earth(const GeoPoint& point) {
  return std::abs(point.latitude) <= 90.0 && point.longitude >= -180.0 &&
         point.longitude <= 360.0;
}

}  // namespace ghtrack

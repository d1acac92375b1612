#include "tools/data/place.hpp"

#include <GeographicLib/AzimuthalEquidistant.hpp>
#include <GeographicLib/DMS.hpp>
#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <cmath>
#include <string>

#include "tools/record/text_file.hpp"

namespace ghtrack {

Eigen::Vector2d to_metres(const GeoPoint& origin, const GeoPoint& point) {
  static const GeographicLib::AzimuthalEquidistant projection;
  Eigen::Vector2d position;
  projection.Forward(origin.latitude, origin.longitude, point.latitude, point.longitude,
                     position.x(), position.y());
  return position + Eigen::Vector2d::Zero();  // without a negative zero
}

GeoPoint to_degrees(const GeoPoint& origin, const Eigen::Vector2d& position) {
  static const GeographicLib::AzimuthalEquidistant projection;
  GeoPoint point;
  projection.Reverse(origin.latitude, origin.longitude, position.x(), position.y(), point.latitude,
                     point.longitude);
  return point;
}

Eigen::Vector2d direction_at(double bearing) {
  Eigen::Vector2d direction;
  GeographicLib::Math::sincosd(bearing, direction.y(), direction.x());
  return direction;
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

std::optional<GeoPoint> parse_place(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const auto number = [&](std::string_view part) {
    const std::size_t start = part.find_first_not_of(kBlanks);
    if (start == std::string_view::npos) return std::optional<double>();
    return parse_number(part.substr(start, part.find_last_not_of(kBlanks) - start + 1));
  };
  const std::size_t open = text.find('(');
  const bool is_well_known =
      (text.starts_with("POINT") || text.starts_with("Point")) && open != std::string_view::npos;
  if (is_well_known) {
    if (text.back() != ')') return std::nullopt;
    text = text.substr(open + 1, text.size() - open - 2);
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  }
  if (text.size() > 2 && ((text.front() == '[' && text.back() == ']') ||
                          (text.front() == '(' && text.back() == ')'))) {
    text = text.substr(1, text.size() - 2);
  }
  const std::size_t joint = text.find_first_of(is_well_known ? " \t" : ",;");
  if (joint == std::string_view::npos) return std::nullopt;
  const auto first = number(text.substr(0, joint));
  const auto second = number(text.substr(joint + 1));
  if (!first || !second) return std::nullopt;
  return is_well_known ? GeoPoint{.latitude = *second, .longitude = *first}
                       : GeoPoint{.latitude = *first, .longitude = *second};
}

bool is_on_earth(const GeoPoint& point) {
  return std::abs(point.latitude) <= 90.0 && point.longitude >= -180.0 && point.longitude <= 360.0;
}

}  // namespace ghtrack

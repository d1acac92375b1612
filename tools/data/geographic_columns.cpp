#include "tools/data/geographic_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/data/time_column.hpp"

namespace ghtrack {
namespace {

// What ships say of their place when they do not know it (ITU-R M.1371).
constexpr GeoPoint kNowhere{.latitude = 91.0, .longitude = 181.0};

/// Whether two columns have whole numbers, one of which no degrees could be.
bool have_parts_of_degrees(const Table& table, std::size_t longitude, std::size_t latitude) {
  constexpr double kLeast = 1e5;
  const char point = table.dialect().point;
  const auto first = parse_number(table.first_value(longitude), point);
  const auto second = parse_number(table.first_value(latitude), point);
  return first && second && std::trunc(*first) == *first && std::trunc(*second) == *second &&
         std::max(std::abs(*first), std::abs(*second)) > kLeast;
}

/// Whether a heading says that its numbers are millionths of degrees.
bool is_in_millionths(const Table& table, std::size_t column) {
  return table.headings()[column].base.ends_with("e6");
}

/// Whether a column is named as FIT, the format of Garmin's devices, names a position.
bool is_of_fit(const Table& table, std::size_t column) {
  return table.headings()[column].base.starts_with("position_l");  // _lat, _long
}

}  // namespace

std::optional<GeographicColumns> GeographicColumns::find(const Table& table,
                                                         std::optional<GeoPoint> origin) {
  const ColumnMap& columns = table.columns();
  const auto place = columns.find(Role::kPlace);
  if (place && columns.is_chosen(Role::kPlace)) {
    return GeographicColumns(table, *place, *place, origin);
  }
  if (columns.has_plane()) return std::nullopt;
  const auto longitude = columns.find(Role::kLongitude), latitude = columns.find(Role::kLatitude);
  if (longitude && latitude) return GeographicColumns(table, *longitude, *latitude, origin);
  if (!place || !parse_place(table.first_value(*place))) return std::nullopt;
  return GeographicColumns(table, *place, *place, origin);
}

GeographicColumns::GeographicColumns(const Table& table, std::size_t longitude,
                                     std::size_t latitude, std::optional<GeoPoint> origin)
    : longitude_(longitude), latitude_(latitude), origin_(origin) {
  if (!have_parts_of_degrees(table, longitude, latitude)) return;
  if (is_of_fit(table, longitude) && is_of_fit(table, latitude)) {
    unit_ = "semicircles";
    scale_ = Scale::of_parts(0x1p31 / 180.0);
  } else if (is_in_millionths(table, longitude) && is_in_millionths(table, latitude)) {
    unit_ = "1e-6 degrees";
    scale_ = Scale::of_parts(1e6);
  } else {
    unit_ = "1e-7 degrees";  // as autopilots log them
    scale_ = Scale::of_parts(1e7);
  }
}

std::optional<Eigen::Vector2d> GeographicColumns::read(Table& table) {
  const auto point = place(table);
  if (!point) return std::nullopt;
  if (point->latitude == kNowhere.latitude && point->longitude == kNowhere.longitude) {
    return std::nullopt;
  }
  if (!is_on_earth(*point)) {
    table.reject(fmt::format("latitude {} and longitude {} are no point of the earth",
                             point->latitude, point->longitude));
    return std::nullopt;
  }
  if (!origin_) origin_ = *point;
  return to_metres(*origin_, *point);
}

std::optional<GeoPoint> GeographicColumns::place(Table& table) const {
  if (in_one_cell()) {
    const std::string_view cell = table.cell(longitude_);
    const auto point = parse_place(cell);
    if (!point && !is_missing(cell)) table.reject_cell(longitude_, "a latitude and a longitude");
    return point;
  }
  const auto longitude = degrees(table, longitude_), latitude = degrees(table, latitude_);
  if (!longitude || !latitude) return std::nullopt;
  return GeoPoint{.latitude = *latitude, .longitude = *longitude};
}

/// A number; also one with minutes and seconds.
std::optional<double> GeographicColumns::degrees(Table& table, std::size_t column) const {
  const std::string_view cell = table.cell(column);
  if (const auto number = table.number(column)) return scale_(*number);
  if (is_missing(cell)) return std::nullopt;
  const auto degrees = parse_degrees(cell, column == latitude_);
  if (!degrees) table.reject_cell(column, "a number of degrees");
  return degrees;
}

std::string GeographicColumns::describe(const Table& table) const {
  std::string text = fmt::format("in m from {} in {}{}", unit_, name_of_column(table, longitude_),
                                 in_one_cell() ? "" : " and " + name_of_column(table, latitude_));
  if (origin_) {
    text += fmt::format(" around latitude {:.7g}, longitude {:.7g}", origin_->latitude,
                        origin_->longitude);
  }
  return text;
}

}  // namespace ghtrack

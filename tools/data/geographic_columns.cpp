#include "tools/data/geographic_columns.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/data/time_column.hpp"

namespace ghtrack {
namespace {

// What ships say of their place when they do not know it (ITU-R M.1371).
constexpr GeoPoint kNowhere{.latitude = 91.0, .longitude = 181.0};

/// Whether a column has whole numbers that no degrees could be.
bool has_parts_of_degrees(const Table& table, std::size_t column) {
  constexpr double kLeast = 1e5;
  const auto first = parse_number(table.first_value(column), table.dialect().point);
  return first && std::abs(*first) > kLeast && std::trunc(*first) == *first;
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
  if (!has_parts_of_degrees(table, longitude) || !has_parts_of_degrees(table, latitude)) return;
  const bool is_fit = is_of_fit(table, longitude) && is_of_fit(table, latitude);
  unit_ = is_fit ? "semicircles" : "1e-7 degrees";  // the latter as autopilots log them
  scale_ = Scale::of_parts(is_fit ? 0x1p31 / 180.0 : 1e7);
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

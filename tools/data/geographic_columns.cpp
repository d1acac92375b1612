#include "tools/data/geographic_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/data/nmea.hpp"
#include "tools/data/time_column.hpp"

namespace ghtrack {
namespace {

/// Whether it is what ships say of their place when they do not know it (ITU-R M.1371).
bool is_nowhere(const GeoPoint& point) {
  return (point.latitude == 91.0 && (point.longitude == 181.0 || point.longitude == 0.0)) ||
         (point.longitude == 181.0 && point.latitude == 0.0);
}

/// The column after a coordinate that says on which side of the equator, or of Greenwich, it is.
std::optional<std::size_t> side_of(const Table& table, std::size_t coordinate,
                                   std::string_view sides) {
  const std::size_t next = coordinate + 1;
  if (next >= table.headings().size()) return std::nullopt;
  const std::string_view first = table.first_cell(next);
  return first.size() == 1 && sides.find(first) != std::string_view::npos ? std::optional(next)
                                                                          : std::nullopt;
}

/// Whether a column holds places: what has a unit does not, nor numbers with a decimal comma, which
/// have no points.
bool has_places(Table& table, std::size_t column) {
  const Heading& heading = table.headings()[column];
  const std::string_view first = table.first_value(column);
  const bool are_numbers = parse_number(first, table.dialect()) && !table.shows(column, '.');
  return parse_place(first) && !heading.unit && heading.unread.empty() && !are_numbers;
}

/// Whether two columns have whole numbers, one of which no degrees could be.
bool have_parts_of_degrees(const Table& table, std::size_t longitude, std::size_t latitude) {
  constexpr double kLeast = 1e5;
  const char point = table.dialect().point;
  const auto first = parse_number(table.first_value(longitude), point);
  const auto second = parse_number(table.first_value(latitude), point);
  return first && second && std::trunc(*first) == *first && std::trunc(*second) == *second &&
         std::max(std::abs(*first), std::abs(*second)) > kLeast;
}

/// Whether two columns have degrees and minutes in one number, as NMEA 0183 writes them: the
/// heading says so, or there are sides beside, and as many digits as only these have.
bool have_minutes(const Table& table, std::size_t longitude, std::size_t latitude, bool has_sides) {
  for (const std::size_t column : {longitude, latitude}) {
    std::string said = table.headings()[column].text;
    std::erase(said, ' ');
    if (said.find("ddmm") != said.npos || said.find("DDMM") != said.npos) return true;
  }
  if (!has_sides) return false;
  const auto first = parse_number(table.first_value(longitude), table.dialect().point);
  const auto second = parse_number(table.first_value(latitude), table.dialect().point);
  if (!first || !second) return false;
  const auto whole_digits = [&](std::size_t column) {
    const std::string_view text = table.first_value(column);
    return std::min(text.find(table.dialect().point), text.size());
  };
  const bool is_padded = whole_digits(latitude) == 4 && whole_digits(longitude) == 5;
  const bool is_beyond = std::abs(*first) > 180.0 || std::abs(*second) > 90.0;
  return (is_padded || is_beyond) && std::abs(*first) < 18060.0 && std::abs(*second) < 9060.0;
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

std::optional<GeographicColumns> GeographicColumns::find(Table& table,
                                                         std::optional<GeoPoint> origin) {
  const ColumnMap& columns = table.columns();
  const auto place = columns.find(Role::kPlace);
  if (place && columns.is_chosen(Role::kPlace)) {
    return GeographicColumns(table, *place, *place, origin);
  }
  if (columns.has_plane()) return std::nullopt;
  const auto longitude = columns.find(Role::kLongitude), latitude = columns.find(Role::kLatitude);
  if (longitude && latitude) return GeographicColumns(table, *longitude, *latitude, origin);
  if (!place || !has_places(table, *place)) return std::nullopt;
  return GeographicColumns(table, *place, *place, origin);
}

GeographicColumns::GeographicColumns(const Table& table, std::size_t longitude,
                                     std::size_t latitude, std::optional<GeoPoint> origin)
    : longitude_(longitude), latitude_(latitude), origin_(origin) {
  if (!in_one_cell()) {
    south_ = side_of(table, latitude, "NSns");
    west_ = side_of(table, longitude, "EWew");
  }
  if (is_in_radians(table.headings()[longitude]) && is_in_radians(table.headings()[latitude])) {
    unit_ = "radians";
    scale_ = Scale(180.0 / std::numbers::pi);
    return;
  }
  if (!in_one_cell() && have_minutes(table, longitude, latitude, south_ && west_)) {
    unit_ = "degrees and minutes (ddmm.mmmm)";
    has_minutes_ = true;
    return;
  }
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
  if (is_nowhere(*point)) return std::nullopt;
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
  const auto signed_by = [&](double degrees, const std::optional<std::size_t>& side,
                             std::string_view negative, const char* expectation) {
    const std::string_view cell = side ? table.cell(*side) : std::string_view();
    if (cell.empty()) return degrees;
    if (cell.size() > 1 || std::string_view("NSEWnsew").find(cell) == std::string_view::npos) {
      table.reject_cell(*side, expectation);
    }
    const bool is_negative = negative.find(cell) != std::string_view::npos;
    return is_negative ? -std::abs(degrees) : degrees;
  };
  return GeoPoint{.latitude = signed_by(*latitude, south_, "Ss", "N or S"),
                  .longitude = signed_by(*longitude, west_, "Ww", "E or W")};
}

/// A number; also one with minutes and seconds.
std::optional<double> GeographicColumns::degrees(Table& table, std::size_t column) const {
  const std::string_view cell = table.cell(column);
  if (const auto number = table.number(column)) {
    if (!has_minutes_) return scale_(*number);
    const auto both = degrees_of_minutes(*number);
    if (!both) table.reject_cell(column, "degrees and minutes as ddmm.mmmm");
    return both;
  }
  if (is_missing(cell)) return std::nullopt;
  const auto degrees = parse_degrees(cell, column == latitude_);
  if (!degrees) table.reject_cell(column, "a number of degrees");
  return degrees;
}

std::string GeographicColumns::describe(const Table& table) const {
  // Whatever stands in brackets behind the names, the unit is known.
  std::string text = fmt::format("in m from {} in {}{}", unit_, name_of_column(table, longitude_),
                                 in_one_cell() ? "" : " and " + name_of_column(table, latitude_));
  if (origin_) {
    text += fmt::format(" around latitude {:.7g}, longitude {:.7g}", origin_->latitude,
                        origin_->longitude);
  }
  return text;
}

}  // namespace ghtrack

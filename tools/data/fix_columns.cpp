#include "tools/data/fix_columns.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

// What ships say of their place when they do not know it (ITU-R M.1371).
constexpr double kNoLatitude = 91.0;
constexpr double kNoLongitude = 181.0;

Scale scale_of(const Table& table, std::size_t column) {
  const auto& unit = table.headings()[column].unit;
  return unit && !unit->is_time ? Scale(unit->scale) : Scale();
}

std::string unit_of(const Table& table, std::size_t column) {
  const auto& unit = table.headings()[column].unit;
  return unit ? unit->name : "m";
}

/// Whether a column of degrees has whole numbers that no degrees could be.
bool has_parts_of_degrees(const Table& table, std::size_t column) {
  constexpr double kLeast = 1e5;
  const auto first = parse_number(table.first_value(column), table.dialect().point);
  return first && std::abs(*first) > kLeast && std::trunc(*first) == *first;
}

/// Whether a column is named as FIT, the format of Garmin's devices, names a position.
bool is_of_fit(const Table& table, std::size_t column) {
  return table.headings()[column].base.starts_with("position_l");  // _lat, _long
}

/// The column whose cells hold latitude and longitude, in a table without columns of their own.
std::optional<std::size_t> place_column(const Table& table) {
  const ColumnMap& columns = table.columns();
  const auto place = columns.find(Role::kPlace);
  if (!place || columns.is_chosen(Role::kPlace)) return place;
  const bool has_others = columns.has_plane() || columns.has_degrees();
  return !has_others && parse_place(table.first_cell(*place)) ? place : std::nullopt;
}

}  // namespace

FixColumns::FixColumns(Table& table, const ReadOptions& options, std::optional<GeoPoint> origin)
    : time_(table, options), origin_(origin) {
  const ColumnMap& columns = table.columns();
  const auto place = place_column(table);
  geographic_ = place || (columns.has_degrees() && !columns.has_plane());
  x_ = place ? *place : table.required(geographic_ ? Role::kLongitude : Role::kX);
  y_ = place ? *place : table.required(geographic_ ? Role::kLatitude : Role::kY);
  table.throw_missing_columns();
  if (!geographic_) {
    origin_.reset();
    x_scale_ = scale_of(table, x_);
    y_scale_ = scale_of(table, y_);
  } else if (has_parts_of_degrees(table, x_) && has_parts_of_degrees(table, y_)) {
    const bool is_fit = is_of_fit(table, x_) && is_of_fit(table, y_);
    degrees_ = is_fit ? "semicircles" : "1e-7 degrees";  // the latter as autopilots log them
    x_scale_ = y_scale_ = Scale::of_parts(is_fit ? 0x1p31 / 180.0 : 1e7);
  }
  const auto both = columns.find(Role::kSigma);
  sigma_x_ = columns.has(Role::kSigmaX) ? columns.find(Role::kSigmaX) : both;
  sigma_y_ = columns.has(Role::kSigmaY) ? columns.find(Role::kSigmaY) : both;
  if (has_sigma()) {
    // An error without a unit of its own is in that of the position.
    const auto& x_unit = table.headings()[*sigma_x_].unit;
    const auto& y_unit = table.headings()[*sigma_y_].unit;
    sigma_x_scale_ = x_unit ? Scale(x_unit->scale) : x_scale_;
    sigma_y_scale_ = y_unit ? Scale(y_unit->scale) : y_scale_;
  }
}

std::optional<Fix> FixColumns::read(Table& table) {
  const auto time = time_.read(table);
  if (!time) return std::nullopt;
  Fix fix{.time = *time, .position = std::nullopt};
  const auto [x, y] = coordinates(table);
  if (!x || !y) {
    const bool x_missing = is_missing(table.cell(x_));
    const bool y_missing = is_missing(table.cell(y_));
    const char* const wanted = x_ == y_      ? "a latitude and a longitude"
                               : geographic_ ? "a number of degrees"
                                             : "a finite number";
    if (!x && !x_missing) table.reject_cell(x_, wanted);
    if (!y && !y_missing && x_ != y_) table.reject_cell(y_, wanted);
    if ((!x && !x_missing) || (!y && !y_missing)) return std::nullopt;
    return fix;
  }
  if (!geographic_) {
    fix.position = Eigen::Vector2d(x_scale_(*x), y_scale_(*y));
    return fix;
  }
  const GeoPoint point{.latitude = y_scale_(*y), .longitude = x_scale_(*x)};
  if (point.latitude == kNoLatitude && point.longitude == kNoLongitude) return fix;
  if (!is_on_earth(point)) {
    table.reject(fmt::format("latitude {} and longitude {} are no point of the earth", *y, *x));
    return std::nullopt;
  }
  if (!origin_) origin_ = point;
  fix.position = to_metres(*origin_, point);
  return fix;
}

FixColumns::Coordinates FixColumns::coordinates(const Table& table) const {
  if (x_ != y_) return {coordinate(table, x_), coordinate(table, y_)};
  const auto place = parse_place(table.cell(x_));
  return place ? Coordinates{place->longitude, place->latitude} : Coordinates{};
}

/// A number; of degrees also one with minutes and seconds.
std::optional<double> FixColumns::coordinate(const Table& table, std::size_t column) const {
  const auto number = table.number(column);
  if (number || !geographic_ || is_missing(table.cell(column))) return number;
  return parse_degrees(table.cell(column), column == y_);
}

std::optional<Eigen::Vector2d> FixColumns::sigma(const Table& table) const {
  if (!has_sigma()) return std::nullopt;
  const auto x = table.number(*sigma_x_);
  const auto y = table.number(*sigma_y_);
  if (!x || !y || !(*x > 0.0) || !(*y > 0.0)) return std::nullopt;
  return Eigen::Vector2d(sigma_x_scale_(*x), sigma_y_scale_(*y));
}

std::string FixColumns::describe(const Table& table) const {
  const auto name = [&](std::size_t column) { return name_of_column(table, column); };
  std::string text = time_.describe(table);
  if (geographic_) {
    text += fmt::format(", x and y in m from {} in {}{}", degrees_, name(x_),
                        x_ == y_ ? "" : " and " + name(y_));
    if (origin_) {
      text += fmt::format(" around latitude {:.7g}, longitude {:.7g}", origin_->latitude,
                          origin_->longitude);
    }
  } else {
    const std::string unit = unit_of(table, x_);
    const bool alike = unit == unit_of(table, y_);
    text += fmt::format(", x and y ({}{}) from {} and {}", unit,
                        alike ? "" : ", " + unit_of(table, y_), name(x_), name(y_));
  }
  if (has_sigma()) text += ", sigma from " + name(*sigma_x_);
  return text;
}

std::optional<GeoPoint> origin_in_columns(const Table& table) {
  const auto latitude = table.column("origin_lat");
  const auto longitude = table.column("origin_lon");
  if (!latitude || !longitude) return std::nullopt;
  const auto lat = parse_number(table.first_cell(*latitude), table.dialect().point);
  const auto lon = parse_number(table.first_cell(*longitude), table.dialect().point);
  if (!lat || !lon) return std::nullopt;
  return GeoPoint{.latitude = *lat, .longitude = *lon};
}

}  // namespace ghtrack

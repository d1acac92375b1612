#include "tools/data/fix_columns.hpp"

#include <fmt/format.h>

#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

std::string unit_of(const Table& table, std::size_t column) {
  const auto& unit = table.headings()[column].unit;
  return unit ? unit->name : "m";
}

}  // namespace

FixColumns::FixColumns(Table& table, const ReadOptions& options, std::optional<GeoPoint> origin)
    : time_(table, options),
      degrees_(GeographicColumns::find(table, origin)),
      polar_(degrees_ ? std::nullopt : PolarColumns::find(table)) {
  const bool is_plane = !degrees_ && !polar_;
  if (is_plane) {
    x_ = table.required(Role::kX);
    y_ = table.required(Role::kY);
  }
  table.throw_missing_columns();
  if (is_plane) {
    x_scale_ = length_scale(table.headings()[x_]);
    y_scale_ = length_scale(table.headings()[y_]);
    zone_ = GridZone::find(table);
  }
  const ColumnMap& columns = table.columns();
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
  const Fix fix{.time = *time, .position = position(table)};
  return table.is_rejected() ? std::nullopt : std::optional(fix);
}

std::optional<Eigen::Vector2d> FixColumns::position(Table& table) {
  if (degrees_) return degrees_->read(table);
  if (polar_) return polar_->read(table);
  if (zone_) zone_->check(table);
  const auto x = table.number_or_missing(x_), y = table.number_or_missing(y_);
  if (!x || !y) return std::nullopt;
  return Eigen::Vector2d(x_scale_(*x), y_scale_(*y));
}

const std::optional<GeoPoint>& FixColumns::origin() const {
  static const std::optional<GeoPoint> kNone;
  return degrees_ ? degrees_->origin() : kNone;
}

std::optional<Eigen::Vector2d> FixColumns::sigma(const Table& table) const {
  if (!has_sigma()) return std::nullopt;
  const auto x = table.number(*sigma_x_);
  const auto y = table.number(*sigma_y_);
  if (!x || !y || !(*x > 0.0) || !(*y > 0.0)) return std::nullopt;
  return Eigen::Vector2d(sigma_x_scale_(*x), sigma_y_scale_(*y));
}

std::string FixColumns::describe(const Table& table) const {
  const auto name = [&](std::size_t column) { return name_of_quantity(table, column); };
  std::string text = time_.describe(table) + ", x and y ";
  if (degrees_) {
    text += degrees_->describe(table);
  } else if (polar_) {
    text += polar_->describe(table);
  } else {
    const std::string unit = unit_of(table, x_);
    const bool alike = unit == unit_of(table, y_);
    text += fmt::format("({}{}) from {} and {}", unit, alike ? "" : ", " + unit_of(table, y_),
                        name(x_), name(y_));
  }
  if (has_sigma()) text += ", sigma from " + name(*sigma_x_);
  if (table.side_by_side()) text += "; " + table.side_by_side()->describe();
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

#include "tools/data/polar_columns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tools/data/place.hpp"
#include "tools/data/time_column.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

/// By the unit of the heading, or because no radians are so large.
bool are_radians(Table& table, std::size_t bearing) {
  const Heading& heading = table.headings()[bearing];
  if (heading.unit) return is_in_radians(heading);
  constexpr double kMostRadians = 6.3;  // rounded up from a whole turn
  if (table.any_first(bearing, [&](std::string_view cell) {
        const auto value = parse_number(cell, table.dialect().point);
        return value && std::abs(*value) > kMostRadians;
      })) {
    return false;
  }
  const auto role =
      to_string(table.columns().has(Role::kCompass) ? Role::kCompass : Role::kBearing);
  throw InputError(fmt::format(
      "{}:1: error: are bearings in {} degrees or radians? --columns '{}={}[deg]' or "
      "'{}={}[rad]' says it",
      table.name(), name_of_column(table, bearing), role, heading.text, role, heading.text));
}

}  // namespace

std::optional<PolarColumns> PolarColumns::find(Table& table) {
  const ColumnMap& columns = table.columns();
  if (!columns.has_polar() || columns.has_plane()) return std::nullopt;
  const auto compass = columns.find(Role::kCompass);
  return PolarColumns(table, *columns.find(Role::kRange),
                      compass ? *compass : *columns.find(Role::kBearing), compass.has_value());
}

PolarColumns::PolarColumns(Table& table, std::size_t range, std::size_t bearing, bool is_compass)
    : range_(range),
      bearing_(bearing),
      is_compass_(is_compass),
      is_in_radians_(are_radians(table, bearing)),
      range_scale_(length_scale(table.headings()[range])) {}

std::optional<Eigen::Vector2d> PolarColumns::read(Table& table) {
  const auto range = table.number_or_missing(range_), bearing = table.number_or_missing(bearing_);
  if (!range || !bearing) return std::nullopt;
  if (*range < 0.0) {
    table.reject_cell(range_, "a distance");
    return std::nullopt;
  }
  const double degrees = is_in_radians_ ? *bearing * (180.0 / std::numbers::pi) : *bearing;
  return range_scale_(*range) * direction_at(is_compass_ ? 90.0 - degrees : degrees);
}

std::string PolarColumns::describe(const Table& table) const {
  return fmt::format("in m from distances in {} and bearings in {}, {} {}",
                     name_of_quantity(table, range_), name_of_quantity(table, bearing_),
                     is_in_radians_ ? "radians" : "degrees",
                     is_compass_ ? "clockwise from y" : "counter-clockwise from x");
}

}  // namespace ghtrack

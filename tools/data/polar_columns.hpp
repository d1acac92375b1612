#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "tools/data/table.hpp"

namespace ghtrack {

/// The columns of a table that say where something was as seen from a site, which is the origin:
/// its distance, and its bearing, counter-clockwise from x, or, if a column was chosen for
/// `compass`, clockwise from y.
class PolarColumns {
 public:
  /// Absent if the table has none, or has coordinates in a plane, which come first.
  /// @throws InputError if it cannot be told whether bearings are degrees or radians
  static std::optional<PolarColumns> find(Table& table);

  /// Where the present row was [m]; absent where it does not say. What is neither a number nor
  /// missing is noted, as are negative distances.
  std::optional<Eigen::Vector2d> read(Table& table);

  /// "in m from distances in 'range (km)' and bearings in 'azimuth', degrees from x".
  std::string describe(const Table& table) const;

 private:
  PolarColumns(Table& table, std::size_t range, std::size_t bearing, bool is_compass);

  std::size_t range_, bearing_;
  bool is_compass_;
  bool is_in_radians_;
  Scale range_scale_;  // to metres
};

}  // namespace ghtrack

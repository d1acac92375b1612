#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "tools/data/place.hpp"
#include "tools/data/table.hpp"

namespace ghtrack {

/// The columns of a table that say where on earth something was: latitude and longitude, in degrees
/// or as devices log them, or both in one cell. They become local metres around an origin.
class GeographicColumns {
 public:
  /// Absent if the table has none, or has coordinates in a plane, which come first.
  /// @param origin  of the local metres; the first point of the file if not given
  static std::optional<GeographicColumns> find(Table& table, std::optional<GeoPoint> origin = {});

  /// Where the present row was [m], x east and y north; absent where it does not say. What is
  /// neither a place nor missing is noted.
  std::optional<Eigen::Vector2d> read(Table& table);

  /// Of the local metres, once a row has been read.
  const std::optional<GeoPoint>& origin() const { return origin_; }

  /// "in m from degrees in 'lon' and 'lat' around latitude 50, longitude 8".
  std::string describe(const Table& table) const;

 private:
  GeographicColumns(const Table& table, std::size_t longitude, std::size_t latitude,
                    std::optional<GeoPoint> origin);

  std::optional<GeoPoint> place(Table& table) const;
  std::optional<double> degrees(Table& table, std::size_t column) const;
  bool in_one_cell() const { return longitude_ == latitude_; }

  std::size_t longitude_, latitude_;
  std::optional<std::size_t> west_, south_;  // columns that say so
  std::string_view unit_ = "degrees";
  Scale scale_;               // to degrees
  bool has_minutes_ = false;  // 4952.365 is 49° 52.365'
  std::optional<GeoPoint> origin_;
};

}  // namespace ghtrack

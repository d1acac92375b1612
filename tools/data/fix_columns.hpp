#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "tools/data/geographic_columns.hpp"
#include "tools/data/grid_zone.hpp"
#include "tools/data/polar_columns.hpp"
#include "tools/data/table.hpp"
#include "tools/data/time_column.hpp"

namespace ghtrack {

/// When and where something was, as a row says.
struct Fix {
  double time = 0.0;                        // [s]
  std::optional<Eigen::Vector2d> position;  // [m]; absent where the row has none
};

/// The columns of a table that hold time and place: seconds, other units, dates or frames; metres,
/// other units, distances and bearings, or degrees, which become metres around an origin.
class FixColumns {
 public:
  /// @param origin  of the local metres; the first point of the file if not given
  /// @throws InputError if columns are missing
  FixColumns(Table& table, const ReadOptions& options, std::optional<GeoPoint> origin = {});

  /// Reads the present row; absent if it was rejected.
  std::optional<Fix> read(Table& table);

  /// The 1-sigma error of the present row per axis [m]; absent if the table does not say.
  std::optional<Eigen::Vector2d> sigma(const Table& table) const;
  bool has_sigma() const { return sigma_x_ && sigma_y_; }

  /// Of the local metres, once a row has been read; absent if the table is in metres.
  const std::optional<GeoPoint>& origin() const;

  /// "t in ms from 'time', x and y in mm from 'East' and 'North'".
  std::string describe(const Table& table) const;

  const TimeColumn& time() const { return time_; }

 private:
  std::optional<Eigen::Vector2d> position(Table& table);

  TimeColumn time_;
  std::optional<GeographicColumns> degrees_;
  std::optional<PolarColumns> polar_;
  std::size_t x_ = 0, y_ = 0;  // without either
  std::optional<GridZone> zone_;
  std::optional<std::size_t> sigma_x_, sigma_y_;
  Scale x_scale_, y_scale_, sigma_x_scale_, sigma_y_scale_;
};

/// The origin of local metres that tracks carry in the columns origin_lat and origin_lon.
std::optional<GeoPoint> origin_in_columns(const Table& table);

}  // namespace ghtrack

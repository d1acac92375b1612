#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/data/table.hpp"

namespace ghtrack {

/// One value for each axis of a series, at most three.
using AxisVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

/// One row of a series.
struct MeasuredRow {
  std::int64_t number = 0;            // from 1
  std::int64_t line = 0;              // of the file
  std::optional<double> time;         // [s]; absent if the series has no times
  std::optional<double> dt, g, h, k;  // of this row alone
  std::optional<AxisVector> z;        // absent unless all axes were measured
  std::optional<AxisVector> truth;
};

/// Whether a series is read with its times.
enum class SeriesTimes {
  kIfThere,
  kIfAsked,  // by a chosen column, or a rate of images; else the rows are evenly spaced
};

/// Reads a series of measurements row by row: bare numbers, one a line; a column `z`, or
/// `zx,zy[,zz]` for more axes; x and y, latitude and longitude, or any other column by its alias or
/// choice; and, where they are there, times, `truth` and `dt,g,h,k`. Lengths become metres, degrees
/// of latitude and longitude local metres. An empty measurement, NaN or NA is a missed one.
///
/// A regular file is gone through once before the first row is given, so that it is refused as a
/// whole. Its rows come in the order of time: a row out of order is put in its place, unless its
/// time is false, which a clock that jumps or stands still can make it. A pipe is read as it comes:
/// what is late there is left out.
class SeriesReader {
 public:
  /// @throws InputError naming file, line, column, what was found and what is allowed
  SeriesReader(const std::string& path, const ReadOptions& options = {},
               SeriesTimes times = SeriesTimes::kIfThere);
  ~SeriesReader();
  SeriesReader(SeriesReader&&) noexcept;

  std::size_t axes() const;
  bool has_times() const;

  /// The median time between rows [s]: of a file, or of the first rows of a pipe; absent without
  /// times.
  std::optional<double> typical_step();

  /// One line: what was read and how. Of a pipe only how.
  std::string understood() const;

  /// Whether there was nothing to understand: the names and units are those of ghtrack itself.
  bool is_plain() const;

  /// The next row; absent after the last.
  /// @throws InputError at a wrong row of a pipe
  std::optional<MeasuredRow> next();

  /// Bad rows that have been left out so far, and what was wrong with the first of them.
  std::int64_t left_out() const;
  const std::vector<std::string>& remarks() const;

  /// Warnings about rows with false times, since the last call.
  std::vector<std::string> take_warnings();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ghtrack

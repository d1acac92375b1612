#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/number_table.hpp"

namespace ghtrack::cli {

/// One row of a series of measurements on up to three axes.
struct MeasuredRow {
  std::int64_t number = 0;  // from 1
  long line = 0;            // of the file
  std::optional<double> t, dt, g, h, k;
  std::vector<std::optional<double>> z, truth;  // by axis; truth: empty if there is none

  bool is_measured() const;
};

/// The rows of a table in the order of their times. A stamp that the rows after it belie, and one
/// that lies before the rows already read, is left out; what is left out is remembered.
class SeriesRows {
 public:
  /// @param t_column  column of the times; empty: rows have none
  /// @throws InputError if there is no column of measurements, or not that one of times
  SeriesRows(NumberTable& table, const std::string& t_column);

  std::size_t axes() const { return z_.size(); }
  bool has_times() const { return t_.has_value(); }
  /// A typical time between rows, by the first of them: their median; nothing without times.
  std::optional<double> typical_step();

  /// The next row; nothing at the end.
  std::optional<MeasuredRow> next();

  /// Remarks on rows that were left out, since the last call.
  std::vector<std::string> take_remarks();

 private:
  bool read_ahead(std::size_t rows);
  MeasuredRow parse(std::int64_t number) const;
  bool is_belied(const MeasuredRow& row);
  void leave_out(const MeasuredRow& row, const char* why);

  NumberTable& table_;
  std::vector<std::size_t> z_, truth_;  // columns by axis
  std::optional<std::size_t> g_, h_, k_, dt_, t_;
  std::deque<MeasuredRow> ahead_;
  std::int64_t rows_ = 0;
  std::int64_t left_out_ = 0;
  std::optional<double> time_;  // of the row before
  std::vector<std::string> remarks_;
};

}  // namespace ghtrack::cli

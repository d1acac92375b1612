#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/data/clock.hpp"
#include "tools/data/table.hpp"

namespace ghtrack {

/// The columns of a table that hold its times: seconds, other units, dates or numbers of images.
class TimeColumn {
 public:
  /// Whether the table has times: a column of them, or one of images whose rate is known.
  static bool is_in(const Table& table, const ReadOptions& options);

  /// @throws InputError if the rate of images is needed and not given; a column that is missing is
  /// a finding of the table
  TimeColumn(Table& table, const ReadOptions& options);

  /// The time of the present row [s]; absent if it was rejected.
  std::optional<double> read(Table& table);

  /// "t (ms) from 'time'".
  std::string describe(const Table& table) const;

  /// A remark where numbers without a unit are rather too far apart for seconds; else empty.
  /// @param period  between rows [s]
  std::string doubt(const Table& table, double period) const;

  /// Whether it is seconds in a column `t`, as ghtrack writes it.
  bool is_plain(const Table& table) const;

 private:
  double of_days(double time, std::int64_t line);

  std::size_t column_ = 0;
  std::optional<std::size_t> date_;         // of a time of day
  std::optional<std::size_t> unused_date_;  // beside seconds from anywhere
  DateOrder order_ = DateOrder::kDayFirst;
  std::optional<std::size_t> nanoseconds_;  // beside whole seconds
  int midnights_ = 0;                       // passed so far
  double of_day_ = 0.0;                     // of the row before [s]
  std::int64_t line_ = 0;                   // of the same
  std::optional<Clock> clock_;
};

/// What a column is called in remarks: 'East (m)', or column 3.
std::string name_of_column(const Table& table, std::size_t column);

/// The same, with a remark where its brackets hold no unit that is known.
std::string name_of_quantity(const Table& table, std::size_t column);

}  // namespace ghtrack

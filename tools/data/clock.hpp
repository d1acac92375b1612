#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tools/data/header.hpp"

namespace ghtrack {

constexpr double kDay = 86400.0;  // [s]

/// What stands first in a date whose year stands last, such as 3/4/2024, or in one of six digits.
enum class DateOrder { kDayFirst, kMonthFirst, kYearFirst };

/// Seconds since 1970-01-01T00:00:00 UTC of a date and time after ISO 8601:
/// `2024-06-11T09:30:15.25+02:00`. T may be a blank, dashes may be slashes, points or missing in
/// both parts (then T, too), seconds may be missing, decimals may follow a comma, a zone may be Z,
/// UTC, ±hh, ±hhmm or ±hh:mm, or one of these after UTC; without one it is UTC. The date may also
/// be `11.06.2024`, `11/06/2024` or, with the month first, `06/11/2024`, `11-Jun-2024`, or `Tue Jun
/// 11 09:30:15 GMT+02:00 2024`; the time may be `9:30:15 AM`. Absent if the text is anything else.
std::optional<double> parse_date_time(std::string_view text,
                                      DateOrder order = DateOrder::kDayFirst);

/// Seconds since midnight of `h:mm[:ss[.fff]] [AM|PM]`, `hh:mm:ss:fff`, or of `mm:ss.f`; more than
/// 24 h have passed on a stopwatch. Absent if the text is anything else.
std::optional<double> parse_time_of_day(std::string_view text);

/// The same of `hhmmss[.fff]`, as loggers of GPS write it; zeros at the front may be missing.
std::optional<double> parse_compact_time(std::string_view text);

/// Days since 1970-01-01 of a date in one of the forms above, or of six digits: `110624`, or
/// `240611` with the year first. Absent if the text is anything else. Years of two digits are from
/// 1970 to 2069.
std::optional<std::int64_t> parse_date(std::string_view text,
                                       DateOrder order = DateOrder::kDayFirst);

/// The way back: `2024-06-11T07:30:15.250Z`, to the millisecond.
std::string format_date_time(double seconds);

/// Whether a cell is a date, or the number of a day as Excel or MATLAB counts them.
bool is_date_or_day(std::string_view text, char point);

/// What is known of a column of times but for its cells.
struct TimeFormat {
  std::optional<Unit> unit = std::nullopt;          // if the heading has one
  std::optional<double> frame_rate = std::nullopt;  // of a column of frame numbers [Hz]
  bool are_dates = false;                           // the heading says so
  bool has_date = false;  // the day stands in another column, and times may be hhmmss
  char point = '.';       // before decimals
};

/// Turns the time of a row into seconds, in the way that the first row shows.
class Clock {
 public:
  /// @param first  the first time of the table
  Clock(const TimeFormat& format, std::string_view first);

  /// The time in seconds, absent if the text is none.
  std::optional<double> seconds(std::string_view time) const;

  /// Whether times start anew at midnight.
  bool is_time_of_day() const { return kind_ == Kind::kTimeOfDay || kind_ == Kind::kCompactTime; }

  /// What a time is, for remarks: "ms", "s since 1970", "ISO 8601".
  const std::string& meaning() const { return meaning_; }

  /// What a wrong time should have been, for messages.
  std::string_view expectation() const;

 private:
  enum class Kind { kNumber, kDateTime, kTimeOfDay, kCompactTime };

  Kind kind_ = Kind::kNumber;
  DateOrder order_ = DateOrder::kDayFirst;
  Scale scale_;
  double epoch_ = 0.0;          // taken away before scaling
  bool is_unreadable_ = false;  // the first time is none
  char point_ = '.';
  std::string suffix_;  // a unit after each number
  std::string meaning_;
};

}  // namespace ghtrack

#include "tools/data/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <ctime>

#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

/// Reads a text from front to back.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }

  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool take(std::string_view word) {
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  bool is_at(char c) const { return !rest_.empty() && rest_.front() == c; }

  /// The same in letters of any size.
  bool take_word(std::string_view word) {
    if (rest_.size() < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
      const auto is = static_cast<unsigned char>(rest_[i]);
      if (std::tolower(is) != std::tolower(static_cast<unsigned char>(word[i]))) return false;
    }
    rest_.remove_prefix(word.size());
    return true;
  }

  std::optional<int> one_or_two_digits() {
    if (const auto two = digits(2)) return two;
    return digits(1);
  }

  /// A number of exactly so many digits.
  std::optional<int> digits(std::size_t count) {
    if (rest_.size() < count) return std::nullopt;
    int value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto digit = static_cast<unsigned>(rest_[i] - '0');
      if (digit > 9) return std::nullopt;
      value = 10 * value + static_cast<int>(digit);
    }
    rest_.remove_prefix(count);
    return value;
  }

  /// The decimals after a point or comma, as a fraction; 0 without any.
  std::optional<double> fraction() {
    if (!take('.') && !take(',')) return 0.0;
    double value = 0.0;
    double power = 1.0;
    std::size_t count = 0;
    while (count < rest_.size() && rest_[count] >= '0' && rest_[count] <= '9') {
      if (count < 15) {
        value = 10.0 * value + (rest_[count] - '0');
        power *= 10.0;
      }
      ++count;
    }
    rest_.remove_prefix(count);
    if (count == 0) return std::nullopt;
    return value / power;
  }

 private:
  std::string_view rest_;
};

/// Days since 1970-01-01 in the Gregorian calendar (Howard Hinnant, "chrono-compatible low-level
/// date algorithms": years begin in March, 400 years have 146 097 days).
std::int64_t days_of(int year, int month, int day) {
  const std::int64_t y = year - (month <= 2 ? 1 : 0);
  const std::int64_t era = (y >= 0 ? y : y - 399) / 400;
  const std::int64_t year_of_era = y - era * 400;
  const std::int64_t day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year -
         719468;
}

/// Days since 1970 of a date, if there is such a day.
std::optional<std::int64_t> checked_days(int year, int month, int day) {
  constexpr std::array<int, 12> kDays = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (month < 1 || month > 12) return std::nullopt;
  if (day < 1 || day > kDays[static_cast<std::size_t>(month - 1)]) return std::nullopt;
  return days_of(year, month, day);
}

/// A month by its English name or the first three letters of it.
std::optional<int> take_month(Cursor& cursor) {
  constexpr std::array<std::string_view, 12> kMonths = {
      "January", "February", "March",     "April",   "May",      "June",
      "July",    "August",   "September", "October", "November", "December"};
  for (std::size_t i = 0; i < kMonths.size(); ++i) {
    if (cursor.take_word(kMonths[i]) || cursor.take_word(kMonths[i].substr(0, 3))) {
      return static_cast<int>(i) + 1;
    }
  }
  return std::nullopt;
}

/// The year from 1970 to 2069 that two digits stand for.
int full_year(int two_digits) { return two_digits + (two_digits < 70 ? 2000 : 1900); }

/// A year of four digits, or of two.
std::optional<int> take_year(Cursor& cursor) {
  if (const auto year = cursor.digits(4)) return year;
  const auto year = cursor.digits(2);
  if (!year) return std::nullopt;
  return full_year(*year);
}

/// 2024-06-11, 2024/06/11, 2024.06.11 or 20240611.
std::optional<std::int64_t> take_year_first(Cursor& cursor) {
  const auto year = cursor.digits(4);
  if (!year) return std::nullopt;
  const char joint = cursor.take('-')   ? '-'
                     : cursor.take('/') ? '/'
                     : cursor.take('.') ? '.'
                                        : '\0';
  const auto month = cursor.digits(2);
  if (!month || (joint != '\0' && !cursor.take(joint))) return std::nullopt;
  const auto day = cursor.digits(2);
  return day ? checked_days(*year, *month, *day) : std::nullopt;
}

/// 11.06.2024, 11/6/2024, 11-Jun-2024, or 6/11/2024.
std::optional<std::int64_t> take_year_last(Cursor& cursor, DateOrder order) {
  const auto first = cursor.one_or_two_digits();
  if (!first) return std::nullopt;
  const char joint = cursor.take('.')   ? '.'
                     : cursor.take('/') ? '/'
                     : cursor.take('-') ? '-'
                     : cursor.take(' ') ? ' '
                                        : '\0';
  if (joint == '\0') return std::nullopt;
  const auto named = take_month(cursor);
  const bool needs_name = joint == '-' || joint == ' ';
  const auto second = named || needs_name ? named : cursor.one_or_two_digits();
  if (!second || !cursor.take(joint)) return std::nullopt;
  const auto year = take_year(cursor);
  if (!year) return std::nullopt;
  const bool month_first = order == DateOrder::kMonthFirst && joint == '/' && !named;
  return month_first ? checked_days(*year, *first, *second) : checked_days(*year, *second, *first);
}

std::optional<std::int64_t> take_date(Cursor& cursor, DateOrder order) {
  Cursor ahead = cursor;
  if (const auto days = take_year_first(ahead)) {
    cursor = ahead;
    return days;
  }
  return take_year_last(cursor, order);
}

/// Makes the hour of a clock with twelve hours one of 24, if AM or PM follows.
bool take_half_of_day(Cursor& cursor, int& hour) {
  Cursor ahead = cursor;
  ahead.take(' ');
  const bool before_noon = ahead.take_word("AM");
  if (!before_noon && !ahead.take_word("PM")) return true;
  if (hour < 1 || hour > 12) return false;
  hour = hour % 12 + (before_noon ? 0 : 12);
  cursor = ahead;
  return true;
}

/// The last part of "09:30:15:250", as a fraction of a second.
std::optional<double> take_milliseconds(Cursor& cursor) {
  Cursor ahead = cursor;
  const auto milliseconds = ahead.take(':') ? ahead.digits(3) : std::nullopt;
  if (!milliseconds || !ahead.at_end()) return std::nullopt;
  cursor = ahead;
  return *milliseconds / 1e3;
}

std::optional<double> take_time(Cursor& cursor) {
  auto hour = cursor.digits(2);
  if (!hour) {
    Cursor ahead = cursor;
    hour = ahead.digits(1);
    if (!hour || !ahead.is_at(':')) return std::nullopt;
    cursor = ahead;
  }
  const bool colon = cursor.take(':');
  const auto minute = cursor.digits(2);
  if (!minute || *minute > 59) return std::nullopt;
  if (colon && cursor.is_at('.')) {  // 00:59.9, as Excel shows what is below an hour
    const auto fraction = cursor.fraction();
    if (!fraction) return std::nullopt;
    return *hour * 60.0 + *minute + *fraction;
  }
  double seconds = 0.0;
  if (colon ? cursor.take(':') : !cursor.at_end()) {
    const auto second = cursor.digits(2);
    if (second) {
      auto fraction = take_milliseconds(cursor);
      if (!fraction) fraction = cursor.fraction();
      if (*second > 60 || !fraction) return std::nullopt;
      seconds = *second + *fraction;
    } else if (colon) {
      return std::nullopt;
    }
  }
  if (!take_half_of_day(cursor, *hour)) return std::nullopt;
  return *hour * 3600.0 + *minute * 60.0 + seconds;
}

/// Seconds that the zone is ahead of UTC; 0 without one.
std::optional<double> take_zone(Cursor& cursor) {
  cursor.take(' ');
  if (cursor.at_end() || cursor.take('Z') || cursor.take('z')) return 0.0;
  if ((cursor.take("UTC") || cursor.take("GMT")) && cursor.at_end()) return 0.0;
  const bool behind = cursor.take('-') || cursor.take("\u2212");
  if (!behind && !cursor.take('+')) return std::nullopt;
  const auto hours = cursor.one_or_two_digits();
  if (!hours || *hours > 14) return std::nullopt;
  int minutes = 0;
  const bool colon = cursor.take(':');
  if (colon || !cursor.at_end()) {
    const auto found = cursor.digits(2);
    if (!found || *found > 59) return std::nullopt;
    minutes = *found;
  }
  const double ahead = *hours * 3600.0 + minutes * 60.0;
  return behind ? -ahead : ahead;
}

/// The days of "1 days 00:00:01.5", as pandas writes times that have passed; 0 without any.
double take_days(Cursor& cursor) {
  Cursor ahead = cursor;
  double days = 0.0;
  for (auto digit = ahead.digits(1); digit; digit = ahead.digits(1)) days = 10.0 * days + *digit;
  if (!ahead.take(" day")) return 0.0;
  ahead.take('s');
  if (!ahead.take(' ')) return 0.0;
  cursor = ahead;
  return days;
}

}  // namespace

std::optional<std::int64_t> parse_date(std::string_view text, DateOrder order) {
  Cursor cursor(text);
  if (text.size() == 6) {
    std::array<std::optional<int>, 3> parts;
    for (auto& part : parts) part = cursor.digits(2);
    if (parts[2]) {
      const std::size_t year = order == DateOrder::kYearFirst ? 0 : 2;
      const std::size_t month = order == DateOrder::kMonthFirst ? 0 : 1;
      return checked_days(full_year(*parts[year]), *parts[month], *parts[3 - year - month]);
    }
    cursor = Cursor(text);
  }
  const auto days = take_date(cursor, order);
  return cursor.at_end() ? days : std::nullopt;
}

std::optional<double> parse_time_of_day(std::string_view text) {
  Cursor cursor(text);
  const double days = take_days(cursor);
  const auto seconds = take_time(cursor);
  const auto zone = seconds ? take_zone(cursor) : std::nullopt;
  if (!zone || !cursor.at_end() || text.find(':') == std::string_view::npos) return std::nullopt;
  return days * kDay + *seconds - *zone;
}

std::optional<double> parse_compact_time(std::string_view text) {
  const std::size_t point = std::min(text.find('.'), text.size());
  if (point == 0 || point > 6) return std::nullopt;
  const std::string padded = std::string(6 - point, '0') + std::string(text);
  Cursor cursor(padded);
  const auto hour = cursor.digits(2), minute = cursor.digits(2), second = cursor.digits(2);
  const auto fraction = second ? cursor.fraction() : std::nullopt;
  if (!hour || !minute || !fraction || !cursor.at_end()) return std::nullopt;
  if (*hour > 23 || *minute > 59 || *second > 60) return std::nullopt;
  return *hour * 3600.0 + *minute * 60.0 + *second + *fraction;
}

namespace {

/// "Tue Jun 11 09:30:15 GMT+02:00 2024", as Java and C write dates: the weekday and the zone may be
/// missing.
std::optional<double> parse_worded_date_time(std::string_view text) {
  Cursor cursor(text);
  for (const std::string_view day : {"Mon", "Tue", "Wed", "Thu", "Fri", "Sat", "Sun"}) {
    if (cursor.take_word(day)) break;
  }
  cursor.take(',');
  cursor.take(' ');
  const auto month = take_month(cursor);
  if (!month || !cursor.take(' ')) return std::nullopt;
  cursor.take(' ');
  const auto day = cursor.one_or_two_digits();
  if (!day || !cursor.take(' ')) return std::nullopt;
  const auto time = take_time(cursor);
  const std::size_t year_at = text.rfind(' ');
  if (!time || *time > kDay || year_at == std::string_view::npos) return std::nullopt;
  Cursor last(text.substr(year_at + 1));
  const auto year = last.digits(4);
  const auto days = year && last.at_end() ? checked_days(*year, *month, *day) : std::nullopt;
  if (!days) return std::nullopt;
  std::string_view zone_text = cursor.rest();
  zone_text = zone_text.substr(0, zone_text.rfind(' '));
  if (zone_text.starts_with(' ')) zone_text.remove_prefix(1);
  Cursor zone_cursor(zone_text);
  if (zone_text.size() > 3 && !zone_cursor.take("GMT")) zone_cursor.take("UTC");
  const auto zone = take_zone(zone_cursor);
  if (!zone || !zone_cursor.at_end()) return std::nullopt;
  return static_cast<double>(*days) * kDay - *zone + *time;
}

}  // namespace

std::optional<double> parse_date_time(std::string_view text, DateOrder order) {
  Cursor cursor(text);
  const auto days = take_date(cursor, order);
  if (!days) return parse_worded_date_time(text);
  const double midnight = static_cast<double>(*days) * kDay;
  if (cursor.at_end()) return midnight;
  const bool is_compact = text.size() >= 14 && text.find_first_not_of("0123456789") >= 14;
  if (!is_compact && !cursor.take('T') && !cursor.take('t')) {
    cursor.take(',');
    if (!cursor.take(' ')) return std::nullopt;
  }
  const auto time = take_time(cursor);
  const auto zone = time ? take_zone(cursor) : std::nullopt;
  if (!zone || !cursor.at_end() || *time > kDay) return std::nullopt;
  return midnight - *zone + *time;
}

std::string format_date_time(double seconds) {
  const auto milliseconds = static_cast<std::int64_t>(std::llround(seconds * 1e3));
  const std::int64_t whole =
      milliseconds >= 0 ? milliseconds / 1000 : -((-milliseconds + 999) / 1000);
  const auto since_1970 = static_cast<std::time_t>(whole);
  std::tm utc{};
  gmtime_r(&since_1970, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc);
  return fmt::format("{}.{:03}Z", text, milliseconds - 1000 * whole);
}

namespace {

/// Days that a program counts, and its number of 1970-01-01.
struct DayCount {
  std::string_view meaning;
  double least, most;  // from about 1955 to 2118
  double epoch;
};
constexpr std::array<DayCount, 2> kDayCounts = {
    {{"days as Excel counts them, as s since 1970", 2e4, 8e4, 25569.0},
     {"days as MATLAB counts them, as s since 1970", 7.14e5, 7.74e5, 719529.0}}};

const DayCount* day_count(double number) {
  const auto found = std::find_if(
      kDayCounts.begin(), kDayCounts.end(),
      [number](const DayCount& days) { return number >= days.least && number <= days.most; });
  return found == kDayCounts.end() ? nullptr : &*found;
}

/// "1.5 sec" as a heading: the number, and the unit after it.
Heading number_and_unit(std::string_view text) {
  const std::size_t joint = text.rfind(' ');
  if (joint == std::string_view::npos) return {};
  return parse_heading(fmt::format("{} ({})", text.substr(0, joint), text.substr(joint + 1)));
}

/// 20240611093015, or 20240611 in a column of dates.
bool is_compact_date(std::string_view text, bool are_dates) {
  const bool has_digits = text.find_first_not_of("0123456789") == std::string_view::npos;
  const bool is_long = text.size() == 14 || (are_dates && text.size() == 8);
  return has_digits && is_long && (text.starts_with("19") || text.starts_with("20")) &&
         parse_date_time(text);
}

}  // namespace

bool is_date_or_day(std::string_view text, char point) {
  const auto number = parse_number(text, point);
  return parse_date_time(text) || parse_date_time(text, DateOrder::kMonthFirst) ||
         (number && day_count(*number) != nullptr);
}

Clock::Clock(const TimeFormat& format, std::string_view first) : point_(format.point) {
  std::optional<double> number = parse_number(first, point_);
  std::optional<Unit> unit = format.unit;
  if (const Heading told = number_and_unit(first); !number && told.unit && told.unit->is_time) {
    unit = told.unit;
    suffix_ = first.substr(first.rfind(' '));
    number = parse_number(first.substr(0, first.rfind(' ')), point_);
  }
  const bool is_free = !format.unit && !format.frame_rate;
  const bool is_compact = is_free && is_compact_date(first, format.are_dates);
  if (!number && parse_time_of_day(first)) {
    kind_ = Kind::kTimeOfDay;
    meaning_ = "time of day";
  } else if (is_compact || (!number && (parse_date_time(first) ||
                                        parse_date_time(first, DateOrder::kMonthFirst)))) {
    kind_ = Kind::kDateTime;
    if (!parse_date_time(first)) order_ = DateOrder::kMonthFirst;
    const bool year_first = first.size() >= 4 && first.find_first_not_of("0123456789") >= 4;
    meaning_ = year_first                                  ? "ISO 8601, as s since 1970"
               : first.find('/') == std::string_view::npos ? "dates, as s since 1970"
               : order_ == DateOrder::kDayFirst            ? "day/month/year, as s since 1970"
                                                           : "month/day/year, as s since 1970";
  } else if (is_free && format.has_date && parse_compact_time(first)) {
    kind_ = Kind::kCompactTime;
    meaning_ = "time of day as hhmmss";
  } else if (format.frame_rate) {
    scale_ = Scale::of_parts(*format.frame_rate);
    meaning_ = fmt::format("frames at {:g} Hz", *format.frame_rate);
  } else if (unit && unit->is_time) {
    meaning_ = unit->name;
    scale_ = Scale(unit->scale);
  } else if (const DayCount* days = number ? day_count(*number) : nullptr;
             days != nullptr && format.are_dates) {
    meaning_ = days->meaning;
    scale_ = Scale(kDay);
    epoch_ = days->epoch;
  } else {
    // Without a unit, a number can be a time since 1970 only if as seconds it would lie thousands
    // of years ahead.
    is_unreadable_ = !number;
    const double size = std::abs(number.value_or(0.0));
    constexpr double kEpochSeconds = 1e8;
    const double parts = size > 1e17 ? 1e9 : size > 1e14 ? 1e6 : size > 1e11 ? 1e3 : 1.0;
    scale_ = Scale::of_parts(parts);
    meaning_ = parts == 1e9           ? "ns since 1970"
               : parts == 1e6         ? "µs since 1970"
               : parts == 1e3         ? "ms since 1970"
               : size > kEpochSeconds ? "s since 1970"
                                      : "s";
  }
}

std::optional<double> Clock::seconds(std::string_view time) const {
  if (kind_ == Kind::kDateTime) return parse_date_time(time, order_);
  if (kind_ == Kind::kTimeOfDay) return parse_time_of_day(time);
  if (kind_ == Kind::kCompactTime) return parse_compact_time(time);
  if (time.ends_with(suffix_)) time.remove_suffix(suffix_.size());
  const std::optional<double> number = parse_number(time, point_);
  if (!number) return std::nullopt;
  return scale_(*number - epoch_);
}

std::string_view Clock::expectation() const {
  return kind_ == Kind::kDateTime      ? "a date and time such as 2024-06-11T09:30:15Z"
         : kind_ == Kind::kTimeOfDay   ? "a time of day such as 09:30:15"
         : kind_ == Kind::kCompactTime ? "a time of day such as 093015"
         : is_unreadable_              ? "a number, or a date and time such as 2024-06-11T09:30:15Z"
                                       : "a finite number";
}

}  // namespace ghtrack

#include "tools/data/clock.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>

#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

constexpr double kDay = 86400.0;

/// Reads a text from front to back.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }

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

std::optional<std::int64_t> take_date(Cursor& cursor) {
  const auto year = cursor.digits(4);
  if (!year) return std::nullopt;
  const char joint = cursor.take('-') ? '-' : cursor.take('/') ? '/' : '\0';
  const auto month = cursor.digits(2);
  if (!month || *month < 1 || *month > 12) return std::nullopt;
  if (joint != '\0' && !cursor.take(joint)) return std::nullopt;
  const auto day = cursor.digits(2);
  constexpr std::array<int, 12> kDays = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (!day || *day < 1 || *day > kDays[static_cast<std::size_t>(*month - 1)]) return std::nullopt;
  return days_of(*year, *month, *day);
}

std::optional<double> take_time(Cursor& cursor) {
  const auto hour = cursor.digits(2);
  if (!hour || *hour > 24) return std::nullopt;
  const bool colon = cursor.take(':');
  const auto minute = cursor.digits(2);
  if (!minute || *minute > 59) return std::nullopt;
  double seconds = 0.0;
  if (colon ? cursor.take(':') : !cursor.at_end()) {
    const auto second = cursor.digits(2);
    if (second) {
      const auto fraction = cursor.fraction();
      if (*second > 60 || !fraction) return std::nullopt;
      seconds = *second + *fraction;
    } else if (colon) {
      return std::nullopt;
    }
  }
  return *hour * 3600.0 + *minute * 60.0 + seconds;
}

/// Seconds that the zone is ahead of UTC; 0 without one.
std::optional<double> take_zone(Cursor& cursor) {
  cursor.take(' ');
  if (cursor.at_end() || cursor.take('Z') || cursor.take('z') || cursor.take("UTC") ||
      cursor.take("GMT")) {
    return 0.0;
  }
  const bool behind = cursor.take('-') || cursor.take("\u2212");
  if (!behind && !cursor.take('+')) return std::nullopt;
  const auto hours = cursor.digits(2);
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

}  // namespace

std::optional<std::int64_t> parse_date(std::string_view text) {
  Cursor cursor(text);
  const auto days = take_date(cursor);
  return cursor.at_end() ? days : std::nullopt;
}

std::optional<double> parse_time_of_day(std::string_view text) {
  Cursor cursor(text);
  const auto seconds = take_time(cursor);
  const auto zone = seconds ? take_zone(cursor) : std::nullopt;
  if (!zone || !cursor.at_end() || text.find(':') == std::string_view::npos) return std::nullopt;
  return *seconds - *zone;
}

std::optional<double> parse_date_time(std::string_view text) {
  Cursor cursor(text);
  const auto days = take_date(cursor);
  if (!days) return std::nullopt;
  const double midnight = static_cast<double>(*days) * kDay;
  if (cursor.at_end()) return midnight;
  if (!cursor.take('T') && !cursor.take('t') && !cursor.take(' ')) return std::nullopt;
  const auto time = take_time(cursor);
  const auto zone = time ? take_zone(cursor) : std::nullopt;
  if (!zone || !cursor.at_end()) return std::nullopt;
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

Clock::Clock(const std::optional<Unit>& unit, std::string_view first, char point,
             std::optional<double> frame_rate)
    : point_(point) {
  const std::optional<double> number = parse_number(first, point);
  if (!number && parse_time_of_day(first)) {
    kind_ = Kind::kTimeOfDay;
    meaning_ = "time of day";
  } else if (!number && parse_date_time(first)) {
    kind_ = Kind::kDateTime;
    meaning_ = "ISO 8601, as s since 1970";
  } else if (frame_rate) {
    scale_ = Scale::of_parts(*frame_rate);
    meaning_ = fmt::format("frames at {:g} Hz", *frame_rate);
  } else if (unit && unit->is_time) {
    meaning_ = unit->name;
    scale_ = Scale(unit->scale);
  } else {
    // Without a unit, a number can be a time since 1970 only if as seconds it would lie thousands
    // of years ahead.
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
  if (kind_ == Kind::kDateTime) return parse_date_time(time);
  if (kind_ == Kind::kTimeOfDay) return parse_time_of_day(time);
  const std::optional<double> number = parse_number(time, point_);
  if (!number) return std::nullopt;
  return scale_(*number);
}

std::optional<double> Clock::seconds(std::string_view date, std::string_view time) const {
  if (kind_ != Kind::kTimeOfDay) return seconds(time);
  const auto days = parse_date(date);
  const auto of_day = parse_time_of_day(time);
  if (!days || !of_day) return std::nullopt;
  return static_cast<double>(*days) * kDay + *of_day;
}

std::string_view Clock::expectation() const {
  return kind_ == Kind::kDateTime    ? "a date and time such as 2024-06-11T09:30:15Z"
         : kind_ == Kind::kTimeOfDay ? "a time of day such as 09:30:15"
                                     : "a finite number";
}

}  // namespace ghtrack

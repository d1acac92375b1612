#include "tools/data/time_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "tools/record/errors.hpp"

namespace ghtrack {

namespace {

/// Whether a heading is one of these words, or ends with one of them, as "header_stamp_secs".
bool ends_with_one(const std::string& base, std::initializer_list<std::string_view> words) {
  const std::string_view last = std::string_view(base).substr(base.find_last_of("_/:") + 1);
  return std::find(words.begin(), words.end(), last) != words.end();
}

/// The column after one of whole seconds that has the rest, as ROS writes its stamps.
std::optional<std::size_t> nanoseconds_beside(const Table& table, std::size_t seconds) {
  if (seconds + 1 >= table.headings().size()) return std::nullopt;
  const bool is_stamp =
      ends_with_one(table.headings()[seconds].base, {"s", "sec", "secs", "seconds"}) &&
      ends_with_one(table.headings()[seconds + 1].base,
                    {"nsec", "nsecs", "nanosec", "nanoseconds"});
  return is_stamp ? std::optional(seconds + 1) : std::nullopt;
}

/// The column of the times; one of dates alone will do.
std::optional<std::size_t> time_column(const Table& table) {
  if (const auto time = table.columns().find(Role::kTime)) return time;
  for (std::size_t i = 0; i < table.headings().size(); ++i) {
    if (nanoseconds_beside(table, i)) return i;
  }
  const auto date = table.columns().find(Role::kDate);
  const char point = table.dialect().point;
  return date && is_date_or_day(table.first_value(*date), point) ? date : std::nullopt;
}

/// Whether a column of digits is hhmmss beside a date: by its length, or that of the date.
bool is_beside_date(const Table& table, std::size_t time) {
  const auto date = table.columns().find(Role::kDate);
  if (!date || *date == time) return false;
  const auto digits = [&](std::size_t column) {
    const std::string_view text = table.first_value(column);
    return std::min(text.find_first_not_of("0123456789"), text.size());
  };
  return digits(time) >= 5 || digits(*date) == 6;
}

}  // namespace

bool TimeColumn::is_in(const Table& table, const ReadOptions& options) {
  return time_column(table) || (options.frame_rate && table.columns().has(Role::kFrame));
}

TimeColumn::TimeColumn(Table& table, const ReadOptions& options) {
  const ColumnMap& columns = table.columns();
  const auto frame = columns.find(Role::kFrame);
  const bool is_chosen = columns.is_chosen(Role::kTime);
  const auto time = time_column(table);
  const bool frames = frame && !is_chosen && (options.frame_rate || !time);
  if (frames && !options.frame_rate) {
    throw InputError(fmt::format(
        "{}:1: error: there is no column 't', and {} counts images; --frame-rate F says how many "
        "there are in a second",
        table.name(), in_quotes(table.headings()[*frame].text)));
  }
  column_ = frames ? *frame : time ? *time : table.required(Role::kTime);
  const std::size_t width = table.headings().size();
  clock_.emplace(TimeFormat{.unit = column_ < width ? table.headings()[column_].unit : std::nullopt,
                            .frame_rate = frames || is_chosen ? options.frame_rate : std::nullopt,
                            .are_dates = columns.find(Role::kDate) == column_,
                            .has_date = is_beside_date(table, column_),
                            .point = table.dialect().point},
                 table.first_value(column_));
  if (clock_->meaning().starts_with("s")) nanoseconds_ = nanoseconds_beside(table, column_);
  const auto date = columns.find(Role::kDate);
  if (!date || *date == column_) return;
  if (!clock_->is_time_of_day()) {
    if (clock_->meaning() == "s") unused_date_ = date;
    return;
  }
  date_ = date;
  const std::string_view first = table.first_value(*date);
  const auto orders = first.size() == 6 ? std::array{DateOrder::kYearFirst, DateOrder::kDayFirst}
                                        : std::array{DateOrder::kDayFirst, DateOrder::kMonthFirst};
  order_ = parse_date(first, orders[0]) || !parse_date(first, orders[1]) ? orders[0] : orders[1];
}

std::optional<double> TimeColumn::read(Table& table) {
  const auto time = clock_->seconds(table.cell(column_));
  if (!time) {
    table.reject_cell(column_, std::string(clock_->expectation()));
    return std::nullopt;
  }
  if (nanoseconds_) {
    const auto nanoseconds = table.number(*nanoseconds_);
    if (!nanoseconds) table.reject_cell(*nanoseconds_, "a finite number");
    return *time + nanoseconds.value_or(0.0) / 1e9;
  }
  if (!date_) return clock_->is_time_of_day() ? of_days(*time, table.line()) : *time;
  const auto day = parse_date(table.cell(*date_), order_);
  if (day) return static_cast<double>(*day) * kDay + *time;
  table.reject_cell(*date_, "a date such as 2024-06-11");
  return std::nullopt;
}

/// A time of day goes on after midnight; a step of more than half a day back is one.
double TimeColumn::of_days(double time, std::int64_t line) {
  if (line <= line_) midnights_ = 0;  // the table is read once more
  const double step = time - of_day_;
  if (line > line_ && line_ > 0 && std::abs(step) > 0.5 * kDay) midnights_ += step < 0.0 ? 1 : -1;
  line_ = line;
  of_day_ = time;
  return midnights_ * kDay + time;
}

std::string TimeColumn::describe(const Table& table) const {
  std::string text =
      fmt::format("t ({}) from {}", clock_->meaning(), name_of_quantity(table, column_));
  if (nanoseconds_) text += " and " + name_of_column(table, *nanoseconds_);
  if (date_) text += " on " + name_of_column(table, *date_);
  if (unused_date_) text += fmt::format(" ({} is not used)", name_of_column(table, *unused_date_));
  return text;
}

std::string TimeColumn::doubt(const Table& table, double period) const {
  constexpr double kSlow = 10.0;      // more was hardly measured in whole seconds
  constexpr double kSlower = 1000.0;  // nor in milliseconds
  if (clock_->meaning() != "s" || table.headings()[column_].unit || period < kSlow) return "";
  return fmt::format(
      "; {:g} s from row to row: if {} is in another unit, such as {}, say so by "
      "--columns 't={}[{}]'",
      period, name_of_column(table, column_), period < kSlower ? "ms" : "µs",
      table.headings()[column_].text, period < kSlower ? "ms" : "us");
}

bool TimeColumn::is_plain(const Table& table) const {
  return table.headings()[column_].text == "t" && clock_->meaning() == "s" && !date_;
}

std::string name_of_column(const Table& table, std::size_t column) {
  const std::string& text = table.headings()[column].text;
  return table.has_header() ? in_quotes(text) : "column " + text;
}

std::string name_of_quantity(const Table& table, std::size_t column) {
  const Heading& heading = table.headings()[column];
  std::string name = name_of_column(table, column);
  if (!heading.unread.empty()) name += fmt::format(" (no unit is {})", in_quotes(heading.unread));
  return name;
}

}  // namespace ghtrack

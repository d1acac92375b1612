#include "tools/data/time_column.hpp"

#include <fmt/format.h>

#include "tools/record/errors.hpp"

namespace ghtrack {

namespace {

/// The column of the times; one of dates alone will do.
std::optional<std::size_t> time_column(const Table& table) {
  if (const auto time = table.columns().find(Role::kTime)) return time;
  const auto date = table.columns().find(Role::kDate);
  return date && parse_date_time(table.first_value(*date)) ? date : std::nullopt;
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
  if (const auto date = columns.find(Role::kDate); date && *date != column_) date_ = date;
  const std::size_t width = table.headings().size();
  clock_.emplace(column_ < width ? table.headings()[column_].unit : std::nullopt,
                 table.first_value(column_), table.dialect().point,
                 frames || is_chosen ? options.frame_rate : std::nullopt);
}

std::optional<double> TimeColumn::read(Table& table) const {
  const auto time = date_ ? clock_->seconds(table.cell(*date_), table.cell(column_))
                          : clock_->seconds(table.cell(column_));
  if (!time) table.reject_cell(column_, std::string(clock_->expectation()));
  return time;
}

std::string TimeColumn::describe(const Table& table) const {
  std::string text =
      fmt::format("t ({}) from {}", clock_->meaning(), name_of_column(table, column_));
  if (date_) text += " on " + name_of_column(table, *date_);
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

}  // namespace ghtrack

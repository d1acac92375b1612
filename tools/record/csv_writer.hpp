#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack {

/// Appends the shortest text that reads back to the same double.
void append_number(std::string& text, double value);

/// Appends a text cell: quoted as RFC 4180 asks where it holds a comma, a quote or a line break,
/// and led by an apostrophe where a spreadsheet would take it for a formula (= + - @).
void append_text(std::string& text, std::string_view value);

/// One row of a CSV file, built cell by cell.
class CsvRow {
 public:
  CsvRow& operator<<(double value) {
    separate();
    Written& before = before_in(column_);
    const auto bits = std::bit_cast<std::uint64_t>(value);
    if (before.size == 0 || before.bits != bits) before = written(value);
    text_.append(before.digits.data(), before.size);
    return *this;
  }

  template <std::integral Integer>
  CsvRow& operator<<(Integer value) {
    separate();
    char digits[24];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }

  CsvRow& operator<<(std::string_view value) {
    separate();
    append_text(text_, value);
    return *this;
  }

  /// An absent value is an empty cell.
  CsvRow& operator<<(const std::optional<double>& value) {
    if (value) return *this << *value;
    separate();
    return *this;
  }

  /// A cell, or several with commas between them, as another row has them.
  CsvRow& copy_cells(std::string_view cells) {
    separate();
    text_ += cells;
    return *this;
  }

  /// Ends the row; further cells start the next one.
  void end() {
    text_ += '\n';
    column_ = 0;
  }

  const std::string& text() const { return text_; }
  void clear() { text_.clear(); }

 private:
  /// A number as it was written last. Columns such as times say the same in many rows in
  /// succession, and finding the shortest digits is most of the work on a row.
  struct Written {
    std::uint64_t bits = 0;
    std::uint8_t size = 0;  // of the digits; 0: nothing yet
    std::array<char, 24> digits{};
  };
  static Written written(double value);

  /// What was written last in a column, counted from 1.
  Written& before_in(std::size_t column) {
    if (before_.size() < column) before_.resize(column);
    return before_[column - 1];
  }

  void separate() {
    if (column_++ > 0) text_ += ',';
  }

  std::string text_;
  std::size_t column_ = 0;  // the cells that the row has
  std::vector<Written> before_;
};

}  // namespace ghtrack

#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>

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
    append_number(text_, value);
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

  /// Ends the row; further cells start the next one.
  void end() {
    text_ += '\n';
    first_ = true;
  }

  const std::string& text() const { return text_; }
  void clear() { text_.clear(); }

 private:
  void separate() {
    if (!first_) text_ += ',';
    first_ = false;
  }

  std::string text_;
  bool first_ = true;
};

}  // namespace ghtrack

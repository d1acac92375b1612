#include "tools/record/csv_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ghtrack {
namespace {

constexpr std::size_t kLongestNumber = 24;

char* write_digits(char* to, std::uint64_t digits, int count) {
  return fmt::detail::format_decimal(to, digits, count).end;
}

/// Writes what std::to_chars() does, in two thirds of its time: it finds the shortest digits by
/// Ryu, this by Dragonbox (Jeon 2020). @return the end of what was written
char* write_shortest(char* to, double value) {
  constexpr double kLargest = 0x1p53;  // beyond it std::to_chars() writes more than the shortest
  const double size = std::abs(value);
  if (!(size > 0.0 && size < kLargest)) return std::to_chars(to, to + kLongestNumber, value).ptr;
  if (value < 0.0) *to++ = '-';
  const auto [digits, exponent] = fmt::detail::dragonbox::to_decimal(size);
  const int count = fmt::detail::count_digits(digits);
  const int whole = count + exponent;  // how many digits stand before the point
  const int power = std::abs(whole - 1);
  const int with_exponent = count + (count > 1 ? 1 : 0) + (power < 100 ? 4 : 5);
  const int without = whole <= 0 ? 2 - whole + count : count > whole ? count + 1 : whole;
  if (with_exponent < without) return std::to_chars(to, to + kLongestNumber, size).ptr;
  if (whole <= 0) {
    *to++ = '0';
    *to++ = '.';
    return write_digits(std::fill_n(to, -whole, '0'), digits, count);
  }
  if (count <= whole) return std::fill_n(write_digits(to, digits, count), whole - count, '0');
  char* const end = write_digits(to + 1, digits, count);
  for (int i = 0; i < whole; ++i) to[i] = to[i + 1];
  to[whole] = '.';
  return end;
}

}  // namespace

void append_number(std::string& text, double value) {
  char digits[kLongestNumber];
  text.append(digits, write_shortest(digits, value));
}

CsvRow::Written CsvRow::written(double value) {
  static_assert(sizeof(Written::digits) >= kLongestNumber);
  Written number{.bits = std::bit_cast<std::uint64_t>(value), .size = 0, .digits = {}};
  char* const begin = number.digits.data();
  number.size = static_cast<std::uint8_t>(write_shortest(begin, value) - begin);
  return number;
}

void append_text(std::string& text, std::string_view value) {
  const bool is_formula =
      !value.empty() && std::string_view("=+-@\t\r").find(value.front()) != std::string_view::npos;
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
    if (is_formula) text += '\'';
    text += value;
    return;
  }
  text += '"';
  if (is_formula) text += '\'';
  for (const char c : value) {
    if (c == '"') text += '"';
    text += c;
  }
  text += '"';
}

}  // namespace ghtrack

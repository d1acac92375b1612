#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack {

/// How the cells of a table are written.
struct Dialect {
  char separator = ',';        // ',', ';', tab, '|' or ' ', which stands for any number of blanks
  char point = '.';            // before the decimals: '.' or ','
  bool has_thousands = false;  // parted by the other of the two: 1,234.5

  std::string describe() const;  // "semicolons, decimal comma"
};

/// Finds out how a table is written from its first lines: the separator is the first of semicolon,
/// tab, bar, comma and blank that the first line has outside quotes; commas inside numbers are
/// decimal unless other numbers have points there, or whole numbers without any stand in the same
/// column.
Dialect recognise_dialect(std::span<const std::string> lines);

/// The finite number that a cell is; absent if it is anything else.
std::optional<double> parse_number(std::string_view text, const Dialect& dialect);

/// Splits a line into cells without the blanks around them. A cell in double quotes may hold
/// separators; doubled quotes in it stand for one. `cells` refer to the line or, for quoted cells
/// with doubled quotes, to `owned`.
void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells,
                 std::vector<std::string>& owned);

/// Whether nothing was measured: an empty cell, or one of NaN, NA, N/A, null, none, - and their
/// kin.
bool is_missing(std::string_view cell);

}  // namespace ghtrack

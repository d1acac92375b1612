#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack {

/// How the cells of a table are written.
struct Dialect {
  char separator = ',';  // ',', ';', tab, '|' or ' ', which stands for any number of blanks
  char point = '.';      // before the decimals: '.' or ','

  std::string describe() const;  // "semicolons, decimal comma"
};

/// Finds out how a table is written from its first lines: the separator is the first of semicolon,
/// tab, bar, comma and blank that the first line has outside quotes; commas inside numbers of a
/// table that other characters separate are decimal.
Dialect recognise_dialect(std::span<const std::string> lines);

/// Splits a line into cells without the blanks around them. A cell in double quotes may hold
/// separators; doubled quotes in it stand for one. `cells` refer to the line or, for quoted cells
/// with doubled quotes, to `owned`.
void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells,
                 std::vector<std::string>& owned);

/// Whether nothing was measured: an empty cell, or one of NaN, NA, N/A, null, none, - and their
/// kin.
bool is_missing(std::string_view cell);

}  // namespace ghtrack

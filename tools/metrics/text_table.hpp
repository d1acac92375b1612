#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ghtrack {

/// A column of a printed table.
struct TextColumn {
  std::string title;
  std::size_t most = 0;        // characters; longer cells are cut and end in "…"
  bool right_aligned = false;  // numbers
  bool continues = false;      // says more of the column before, and stays beside it
};

/// The text in at most `most` characters, safe for a terminal: control characters, direction
/// overrides and bytes that are not UTF-8 become "?".
std::string printable(std::string_view text, std::size_t most);

/// How a table is fitted to a terminal.
struct TableFit {
  std::size_t width = 80;    // characters of a line
  std::size_t repeated = 1;  // first columns, which name the rows
};

/// Rows under a heading, in columns as wide as their widest cell. What is wider than the terminal
/// is set as several tables one below the other, each with the columns that name the rows.
std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows, const TableFit& fit = {});

}  // namespace ghtrack

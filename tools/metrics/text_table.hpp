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
};

/// The text in at most `most` characters, safe for a terminal: control characters, direction
/// overrides and bytes that are not UTF-8 become "?".
std::string printable(std::string_view text, std::size_t most);

/// Rows under a heading, in columns as wide as their widest cell.
std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows);

}  // namespace ghtrack

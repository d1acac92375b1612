#include "tools/metrics/text_table.hpp"

#include <algorithm>
#include <cstdint>

namespace ghtrack {
namespace {

constexpr std::string_view kGap = "  ";

/// Length in bytes of the valid UTF-8 character at the start of `text`; 0 if there is none.
std::size_t character_length(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) {
    code = lead;
    return 1;
  }
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  code = lead & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const std::uint32_t least = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return code < least || code > 0x10ffff || is_surrogate ? 0 : length;
}

bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200b && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2060 && code <= 0x206f) || code == 0xfeff;
}

std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

void append_cell(std::string& line, const std::string& cell, std::size_t columns, bool right) {
  const std::string padding(columns - width(cell), ' ');
  line += right ? padding + cell : cell + padding;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::vector<std::string> characters;
  while (!text.empty() && characters.size() <= most) {
    std::uint32_t code = 0;
    const std::size_t length = character_length(text, code);
    const bool plain = length > 0 && !is_control(code);
    characters.emplace_back(plain ? text.substr(0, length) : "?");
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  if (characters.size() > most) {
    characters.resize(most);
    if (most > 0) characters.back() = "…";
  }
  std::string result;
  for (const std::string& character : characters) result += character;
  return result;
}

std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::vector<std::string>> cells(1);
  for (const TextColumn& column : columns) cells[0].push_back(printable(column.title, column.most));
  for (const std::vector<std::string>& row : rows) {
    auto& line = cells.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      line.push_back(printable(row.at(i), columns[i].most));
    }
  }
  std::vector<std::size_t> widths(columns.size(), 0);
  for (const auto& line : cells) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], width(line[i]));
  }
  std::string text;
  for (const auto& line : cells) {
    std::string row;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (i > 0) row += kGap;
      append_cell(row, line[i], widths[i], columns[i].right_aligned);
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + '\n';
  }
  return text;
}

}  // namespace ghtrack

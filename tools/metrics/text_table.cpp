#include "tools/metrics/text_table.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "scenes/schema/utf8.hpp"

namespace ghtrack {
namespace {

constexpr std::string_view kGap = "  ";

bool is_hidden(char32_t code) {
  return schema::is_control(code) || (code >= 0x200b && code <= 0x200f) ||
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

using Cells = std::vector<std::vector<std::string>>;

/// Cuts the cells of the columns that name the rows, where these take more than their share.
void shorten_names(Cells& cells, std::size_t columns, std::size_t most) {
  constexpr std::size_t kLeast = 8;
  std::size_t total = 0;
  for (std::size_t i = 0; i < columns; ++i) {
    std::size_t widest = 0;
    for (const auto& line : cells) widest = std::max(widest, width(line[i]));
    total += widest + kGap.size();
  }
  if (total <= most) return;
  const std::size_t share = std::max(kLeast, most / columns - kGap.size());
  for (auto& line : cells) {
    for (std::size_t i = 0; i < columns; ++i) line[i] = printable(line[i], share);
  }
}

/// One past the last of the columns that stay together from `first` on.
std::size_t end_of_group(const std::vector<TextColumn>& columns, std::size_t first) {
  std::size_t end = first + 1;
  while (end < columns.size() && columns[end].continues) ++end;
  return end;
}

/// Some of the columns as lines.
void append_block(std::string& text, const Cells& cells, const std::vector<TextColumn>& columns,
                  const std::vector<std::size_t>& widths, const std::vector<std::size_t>& shown) {
  for (const auto& line : cells) {
    std::string row;
    for (const std::size_t i : shown) {
      if (i != shown.front()) row += kGap;
      append_cell(row, line[i], widths[i], columns[i].right_aligned);
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + '\n';
  }
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::vector<std::string> characters;
  while (!text.empty() && characters.size() <= most) {
    const auto character = schema::first_character(text);
    const std::size_t length = character ? character->size : 1;
    const bool plain = character && !is_hidden(character->code);
    characters.emplace_back(plain ? text.substr(0, length) : "?");
    text.remove_prefix(length);
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
                       const std::vector<std::vector<std::string>>& rows, const TableFit& fit) {
  Cells cells(1);
  for (const TextColumn& column : columns) cells[0].push_back(printable(column.title, column.most));
  for (const std::vector<std::string>& row : rows) {
    auto& line = cells.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      line.push_back(printable(row.at(i), columns[i].most));
    }
  }
  const std::size_t repeated = std::min(fit.repeated, columns.size());
  shorten_names(cells, repeated, fit.width / 2);
  std::vector<std::size_t> widths(columns.size(), 0);
  for (const auto& line : cells) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], width(line[i]));
  }
  std::string text;
  for (std::size_t next = repeated; next < columns.size() || text.empty();) {
    std::vector<std::size_t> shown(repeated);
    std::iota(shown.begin(), shown.end(), std::size_t{0});
    std::size_t used = 0;
    for (const std::size_t i : shown) used += widths[i] + kGap.size();
    while (next < columns.size()) {
      const std::size_t end = end_of_group(columns, next);
      std::size_t with_group = used;
      for (std::size_t i = next; i < end; ++i) with_group += widths[i] + kGap.size();
      if (shown.size() > repeated && with_group - kGap.size() > fit.width) break;
      for (; next < end; ++next) shown.push_back(next);
      used = with_group;
    }
    if (!text.empty()) text += '\n';
    append_block(text, cells, columns, widths, shown);
  }
  return text;
}

}  // namespace ghtrack

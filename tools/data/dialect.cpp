#include "tools/data/dialect.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Whether a character stands in the line outside of quotes and brackets: "Position (x, m)" has no
/// separator.
bool separates(std::string_view line, char separator) {
  bool quoted = false;
  int depth = 0;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '(' || c == '[') ++depth;
    if ((c == ')' || c == ']') && depth > 0) --depth;
    if (c == separator && depth == 0) return true;
  }
  return false;
}

/// "12,5" and its kin: a number with a comma in it.
bool has_decimal_comma(std::string_view cell) {
  return cell.find(',') != std::string_view::npos && parse_number(cell, ',').has_value();
}

/// "0,5 12,25 7": whether every line is as many numbers between blanks, some with decimal commas.
bool are_blanks_with_decimal_commas(std::span<const std::string> lines) {
  std::vector<std::string_view> cells;
  std::vector<std::string> owned;
  std::size_t count = 0;
  bool any = false;
  for (const std::string& line : lines) {
    if (trimmed(line).empty()) continue;
    split_cells(line, ' ', cells, owned);
    if (cells.size() < 2 || (count != 0 && cells.size() != count)) return false;
    count = cells.size();
    for (const std::string_view cell : cells) {
      if (!parse_number(cell, ',') && !is_missing(cell)) return false;
      any = any || has_decimal_comma(cell);
    }
  }
  return any;
}

/// A cell that starts with a quote: its value, and the rest of the line after the closing quote.
std::string_view take_quoted(std::string_view& rest, std::vector<std::string>& owned) {
  std::string value;
  std::size_t i = 1;
  bool doubled = false;
  for (; i < rest.size(); ++i) {
    if (rest[i] == '"') {
      if (i + 1 == rest.size() || rest[i + 1] != '"') break;
      ++i;
      doubled = true;
    }
    value += rest[i];
  }
  if (i >= rest.size()) {  // never closed: the cell shows its quote
    const std::string_view cell = rest;
    rest = {};
    return cell;
  }
  const std::string_view inside = rest.substr(1, i - 1);
  rest.remove_prefix(i + 1);
  return doubled ? std::string_view(owned.emplace_back(std::move(value))) : inside;
}

constexpr std::array<char, 4> kMarks = {';', '\t', '|', ','};  // that separate, but for blanks
constexpr std::size_t kMostTitles = 4;                         // or it is one column

/// The mark that every line has, each as often; none if there is no such, or fewer than two lines.
std::optional<char> agreed_mark(std::span<const std::string> lines) {
  if (lines.size() < 2) return std::nullopt;
  const auto agree = [&](char mark) {
    const auto count = [&](const std::string& line) {
      return std::count(line.begin(), line.end(), mark);
    };
    const auto first = count(lines.front());
    return first > 0 && std::all_of(lines.begin(), lines.end(), [&](const std::string& line) {
             return trimmed(line).empty() || count(line) == first;
           });
  };
  const auto found = std::find_if(kMarks.begin(), kMarks.end(), agree);
  return found == kMarks.end() ? std::nullopt : std::optional(*found);
}

/// What separates the cells; nothing if there is one column.
std::optional<char> find_separator(std::span<const std::string> lines) {
  const std::string_view first = trimmed(lines.front());
  for (const char mark : kMarks) {
    if (separates(first, mark)) return mark;
  }
  const bool has_blanks = separates(first, ' ');
  if (has_blanks && are_blanks_with_decimal_commas(lines.subspan(1))) return ' ';
  for (std::size_t i = 1; i < std::min(lines.size(), kMostTitles); ++i) {
    if (has_blanks) {  // a title such as "mass A" if all lines below it agree
      if (const auto mark = agreed_mark(lines.subspan(i))) return mark;
      continue;
    }
    const std::string_view line = trimmed(lines[i]);
    for (const char mark : kMarks) {
      if (separates(line, mark) && !(mark == ',' && has_decimal_comma(line))) return mark;
    }
  }
  return has_blanks ? std::optional(' ') : std::nullopt;
}

}  // namespace

std::string Dialect::describe() const {
  std::string text = separator == ';'    ? "semicolons"
                     : separator == '\t' ? "tabs"
                     : separator == '|'  ? "bars"
                     : separator == ' '  ? "blanks"
                                         : "commas";
  if (point == ',') text += ", decimal comma";
  return text;
}

Dialect recognise_dialect(std::span<const std::string> lines) {
  Dialect dialect;
  if (lines.empty()) return dialect;
  const std::optional<char> separator = find_separator(lines);
  if (!separator) {  // one column
    const bool has_comma = std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
      return has_decimal_comma(trimmed(line));
    });
    return has_comma ? Dialect{.separator = ';', .point = ','} : dialect;
  }
  dialect.separator = *separator;
  if (dialect.separator == ',' && are_blanks_with_decimal_commas(lines)) {
    return {.separator = ' ', .point = ','};
  }
  std::vector<std::string_view> cells;
  std::vector<std::string> owned;
  for (const std::string& line : lines) {
    split_cells(line, dialect.separator, cells, owned);
    if (std::any_of(cells.begin(), cells.end(), has_decimal_comma)) dialect.point = ',';
  }
  return dialect;
}

void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells,
                 std::vector<std::string>& owned) {
  cells.clear();
  const bool blanks = separator == ' ';
  const bool quotes = line.find('"') != std::string_view::npos;
  if (quotes) {
    owned.clear();  // views into it stay valid because it never grows beyond this
    owned.reserve(static_cast<std::size_t>(std::count(line.begin(), line.end(), '"')));
  }
  if (blanks) line = trimmed(line);
  for (;;) {
    if (quotes) {
      const std::string_view ahead = separator == '\t' ? line : trimmed(line);
      if (!ahead.empty() && ahead.front() == '"') {
        line = ahead;
        const std::string_view value = take_quoted(line, owned);
        const std::size_t end = blanks ? line.find_first_of(" \t") : line.find(separator);
        // Text between the closing quote and the separator belongs to the cell: it will be refused.
        const std::string_view after = trimmed(line.substr(0, end));
        cells.push_back(after.empty() ? value : after);
        if (end == std::string_view::npos) return;
        line.remove_prefix(end + 1);
        if (blanks) line = trimmed(line);
        continue;
      }
    }
    const std::size_t end = blanks ? line.find_first_of(" \t") : line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
    if (blanks) line = trimmed(line);
  }
}

bool is_missing(std::string_view cell) {
  if (cell.empty()) return true;
  // Of numpy, R, pandas, SQL, Excel and Stata.
  constexpr std::array<std::string_view, 17> kWords = {
      "nan",  "+nan", "-nan", "na",  "n/a", "<na>", "nat", "null", "\\n",
      "none", "#n/a", "#nv",  "nil", "-",   "--",   "?",   "."};
  if (cell.size() > 4) return false;
  char lower[4];
  for (std::size_t i = 0; i < cell.size(); ++i) {
    lower[i] = static_cast<char>(std::tolower(static_cast<unsigned char>(cell[i])));
  }
  return std::find(kWords.begin(), kWords.end(), std::string_view(lower, cell.size())) !=
         kWords.end();
}

}  // namespace ghtrack

#include "tools/data/dialect.hpp"

#include <fmt/format.h>

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

/// Reads digits from the front. @returns how many there were
std::size_t take_digits(std::string_view& text) {
  std::size_t count = 0;
  while (count < text.size() && text[count] >= '0' && text[count] <= '9') ++count;
  text.remove_prefix(count);
  return count;
}

/// "1,234" or "1.234.567,5": how many marks part the thousands of a number; 0 if it is none.
std::size_t thousands_marks(std::string_view cell, char mark) {
  if (cell.starts_with('-') || cell.starts_with('+')) cell.remove_prefix(1);
  if (cell.starts_with('0')) return 0;
  const std::size_t leading = take_digits(cell);
  if (leading < 1 || leading > 3) return 0;
  std::size_t marks = 0;
  for (; cell.starts_with(mark); ++marks) {
    cell.remove_prefix(1);
    if (take_digits(cell) != 3) return 0;
  }
  if (!cell.empty() && cell.front() != mark && (cell.front() == '.' || cell.front() == ',')) {
    cell.remove_prefix(1);
    take_digits(cell);
  }
  return cell.empty() ? marks : 0;
}

/// What the cells of a table say of the mark before the decimals.
struct MarkCount {
  std::size_t decimal = 0;    // can be nothing else: "1,5", "1.234,5"
  std::size_t either = 0;     // decimals or thousands: "1,234"
  std::size_t thousands = 0;  // can be nothing else: "1,234,567", "1,234.5"

  void add(std::string_view cell, char mark, char other) {
    const std::size_t marks = thousands_marks(cell, mark);
    const bool is_decimal = cell.find(mark) != std::string_view::npos &&
                            (parse_number(cell, mark) || thousands_marks(cell, other) > 0);
    const bool parts = marks > 1 || (marks > 0 && cell.find(other) != std::string_view::npos);
    if (parts) {
      ++thousands;
    } else if (marks == 1 && is_decimal) {
      ++either;
    } else if (is_decimal) {
      ++decimal;
    }
  }
};

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
constexpr std::size_t kFewestRows = 6;                         // below more of them

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

/// Finds out which mark stands before the decimals and which one parts thousands, if any. A number
/// such as "1,234" may be either: beside whole numbers in its column it is thousands, since with
/// decimals 999 would be 999,000.
void find_decimals(std::span<const std::string> lines, Dialect& dialect) {
  MarkCount commas, points;
  std::vector<std::string_view> cells;
  std::vector<std::string> owned;
  std::vector<bool> has_either, has_whole;  // of each column
  for (const std::string& line : lines) {
    split_cells(line, dialect.separator, cells, owned);
    has_either.resize(std::max(has_either.size(), cells.size()));
    has_whole.resize(has_either.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t before = commas.either;
      commas.add(cells[i], ',', '.');
      points.add(cells[i], '.', ',');
      has_either[i] = has_either[i] || commas.either > before;
      has_whole[i] = has_whole[i] || (parse_whole(cells[i]) && cells[i].find('.') == cells[i].npos);
    }
  }
  bool are_thousands = points.decimal > 0 || commas.thousands > 0;
  for (std::size_t i = 0; i < has_either.size(); ++i) {
    are_thousands = are_thousands || (has_either[i] && has_whole[i]);
  }
  const bool is_comma = commas.decimal > points.decimal ||
                        (commas.decimal == 0 && commas.either > 0 && !are_thousands);
  dialect.point = is_comma ? ',' : '.';
  const MarkCount& other = is_comma ? points : commas;
  dialect.has_thousands = other.thousands + other.either > 0;
}

/// What separates the cells; nothing if there is one column.
std::optional<char> find_separator(std::span<const std::string> lines) {
  const std::string_view first = trimmed(lines.front());
  for (const char mark : kMarks) {
    if (separates(first, mark)) return mark;
  }
  const bool has_blanks = separates(first, ' ');
  if (has_blanks && are_blanks_with_decimal_commas(lines.subspan(1))) return ' ';
  if (has_blanks) {  // a title such as "mass A" if all lines below it, and others, agree
    for (std::size_t i = 1; i < lines.size(); ++i) {
      if (i >= kMostTitles && lines.size() - i < kFewestRows) break;
      if (const auto mark = agreed_mark(lines.subspan(i))) return mark;
    }
    return ' ';
  }
  for (std::size_t i = 1; i < std::min(lines.size(), kMostTitles); ++i) {
    const std::string_view line = trimmed(lines[i]);
    for (const char mark : kMarks) {
      if (separates(line, mark) && !(mark == ',' && has_decimal_comma(line))) return mark;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string Dialect::describe() const {
  std::string text = separator == ';'    ? "semicolons"
                     : separator == '\t' ? "tabs"
                     : separator == '|'  ? "bars"
                     : separator == ' '  ? "blanks"
                                         : "commas";
  if (point == ',') text += ", decimal comma";
  if (has_thousands) text += fmt::format(", '{}' between thousands", point == ',' ? '.' : ',');
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
  find_decimals(lines, dialect);
  return dialect;
}

std::optional<double> parse_number(std::string_view text, const Dialect& dialect) {
  const auto plain = parse_number(text, dialect.point);
  if (plain || !dialect.has_thousands) return plain;
  const char mark = dialect.point == ',' ? '.' : ',';
  if (thousands_marks(text, mark) == 0) return std::nullopt;
  std::string digits(text);
  std::erase(digits, mark);
  return parse_number(digits, dialect.point);
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

#include "scenes/schema/source_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/schema/utf8.hpp"

namespace ghtrack::schema {
namespace {

/// Text in a wider encoding has zero bytes among its first four.
bool looks_like_utf16_or_32(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
  const std::string_view start = text.substr(0, 4);
  return start.size() >= 2 && std::count(start.begin(), start.end(), '\0') >= 1 &&
         std::any_of(start.begin(), start.end(), [](char c) { return c > ' ' && c < 0x7F; }) &&
         (start[0] == '\0' || start[1] == '\0');
}

}  // namespace

SourceText::SourceText(std::string_view text) : text_(text), line_starts_{0} {
  if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  characters_before_.reserve(text_.size() + 1);
  characters_before_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
    const bool continues = (static_cast<unsigned char>(text_[i]) & 0xC0U) == 0x80U;
    characters_before_.push_back(characters_before_.back() + (continues ? 0 : 1));
  }
}

std::size_t SourceText::offset(int line, int column) const {
  if (line < 0 || line >= lines()) return text_.size();
  return std::min(line_starts_[line] + static_cast<std::size_t>(std::max(column, 0)), text_.size());
}

Position SourceText::position(std::size_t offset) const {
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const auto line = static_cast<int>(next - line_starts_.begin());
  return {line, characters_before_[offset] - characters_before_[*(next - 1)] + 1};
}

std::optional<SourceText::Flaw> SourceText::flaw() const {
  if (looks_like_utf16_or_32(text_)) {
    return Flaw{0, "the file is in UTF-16 or UTF-32; save it as UTF-8"};
  }
  for (std::size_t at = 0; at < text_.size();) {
    const auto character = first_character(text_.substr(at));
    if (!character) {
      return Flaw{at, fmt::format("byte 0x{:02x} is not UTF-8 text; save the file as UTF-8",
                                  static_cast<unsigned char>(text_[at]))};
    }
    const char32_t code = character->code;
    const bool line_end = code == '\r' && at + 1 < text_.size() && text_[at + 1] == '\n';
    if (code == '\r' && !line_end) {
      return Flaw{at, "a carriage return without a line feed; end lines with LF or CRLF"};
    }
    if (is_control(code) && code != '\t' && code != '\n' && !line_end) {
      return Flaw{at, fmt::format("control character U+{:04X} is not allowed",
                                  static_cast<unsigned>(code))};
    }
    at += character->size;
  }
  return std::nullopt;
}

std::size_t SourceText::end_of_quoted(std::size_t quote) const {
  const char mark = text_[quote];
  for (std::size_t i = quote + 1; i < text_.size() && text_[i] != '\n'; ++i) {
    const bool escape = mark == '"' && text_[i] == '\\';
    const bool doubled = mark == '\'' && text_.substr(i, 2) == "''";
    if (escape || doubled) {
      ++i;
    } else if (text_[i] == mark) {
      return i;
    }
  }
  return std::string_view::npos;
}

bool SourceText::closes_on_its_line(std::size_t quote) const {
  return end_of_quoted(quote) != std::string_view::npos;
}

std::optional<std::size_t> SourceText::unclosed_quote(std::size_t from) const {
  for (std::size_t i = from; i < text_.size(); ++i) {
    const char before = i == 0 ? '\n' : text_[i - 1];
    const bool after_space = std::string_view(" \t\n").find(before) != std::string_view::npos;
    const bool starts =
        after_space || std::string_view("[{,:").find(before) != std::string_view::npos;
    if (text_[i] == '#' && after_space) {
      i = std::min(text_.find('\n', i), text_.size());
    } else if (starts && (text_[i] == '"' || text_[i] == '\'')) {
      const std::size_t end = end_of_quoted(i);
      if (end == std::string_view::npos) return i;
      i = end;
    }
  }
  return std::nullopt;
}

bool SourceText::is_indented_with_tab(std::size_t offset) const {
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::string_view line = text_.substr(*(next - 1));
  return line.substr(0, line.find_first_not_of(" \t")).find('\t') != std::string_view::npos;
}

}  // namespace ghtrack::schema

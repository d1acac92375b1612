#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/document.hpp"

namespace ghtrack::schema {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The text of a document and its lines, for finding where things stand.
class SourceText {
 public:
  /// Takes away a byte order mark.
  explicit SourceText(std::string_view text);

  std::string_view text() const { return text_; }
  int lines() const { return static_cast<int>(line_starts_.size()); }

  /// Byte offset of a 0-based line and byte column, at most the text's end.
  std::size_t offset(int line, int column) const;
  Position position(std::size_t offset) const;

  /// What makes the bytes unfit for a YAML reader: an encoding other than UTF-8, control
  /// characters, a line end that is a carriage return alone.
  struct Flaw {
    std::size_t offset = 0;
    std::string message;
  };
  std::optional<Flaw> flaw() const;

  /// Offset of the first quoted text at or after `from` that is not closed on its own line.
  std::optional<std::size_t> unclosed_quote(std::size_t from) const;

  /// Is the quoted text that begins here closed on its own line?
  bool closes_on_its_line(std::size_t quote) const;

  /// Does the line with this offset begin with white space that has a tab in it?
  bool is_indented_with_tab(std::size_t offset) const;

 private:
  std::size_t end_of_quoted(std::size_t quote) const;

  std::string_view text_;
  std::vector<std::size_t> line_starts_;
  std::vector<int> characters_before_;  // each byte
};

}  // namespace ghtrack::schema

#include "tools/record/csv_writer.hpp"

namespace ghtrack {

void append_number(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append_text(std::string& text, std::string_view value) {
  const bool is_formula =
      !value.empty() && std::string_view("=+-@\t\r").find(value.front()) != std::string_view::npos;
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
    if (is_formula) text += '\'';
    text += value;
    return;
  }
  text += '"';
  if (is_formula) text += '\'';
  for (const char c : value) {
    if (c == '"') text += '"';
    text += c;
  }
  text += '"';
}

}  // namespace ghtrack

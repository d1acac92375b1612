#include "tools/render/text.hpp"

#include <cstddef>
#include <cstdio>
#include <utility>

#include "scenes/schema/utf8.hpp"

namespace ghtrack::render {

namespace {

/// Reads one character and moves on; what is not UTF-8 counts byte by byte and has no glyph.
char32_t next_character(std::string_view text, std::size_t& at) {
  constexpr char32_t kInvalid = 0x110000;
  const auto character = schema::first_character(text.substr(at));
  at += character ? character->size : 1;
  return character ? character->code : kInvalid;
}

bool in(char32_t character, std::initializer_list<std::pair<char32_t, char32_t>> ranges) {
  for (const auto& [first, last] : ranges)
    if (character >= first && character <= last) return true;
  return false;
}

/// Latin, Greek, Cyrillic and signs that mean something in a technical text.
bool has_glyph(char32_t character) {
  return in(character, {{0x20, 0x7E},     {0xA0, 0xAC},     {0xAE, 0x24F},    {0x370, 0x377},
                        {0x37B, 0x37F},   {0x384, 0x38A},   {0x38C, 0x38C},   {0x38E, 0x3A1},
                        {0x3A3, 0x3FF},   {0x400, 0x45F},   {0x1E00, 0x1EFF}, {0x2010, 0x2015},
                        {0x2018, 0x2022}, {0x2026, 0x2026}, {0x2030, 0x2033}, {0x2070, 0x2071},
                        {0x2074, 0x208E}, {0x20AC, 0x20AC}, {0x2190, 0x2199}, {0x2200, 0x2265}});
}

bool is_direction_mark(char32_t character) {
  return in(character, {{0x200B, 0x200F}, {0x202A, 0x202E}, {0x2060, 0x2069}, {0xFEFF, 0xFEFF}});
}

bool is_blank(char32_t character) {
  return character <= 0x20 || in(character, {{0x7F, 0xA0}, {0x2028, 0x2029}});
}

}  // namespace

std::u32string drawable(std::string_view text, std::size_t longest) {
  std::u32string result;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t character = next_character(text, at);
    if (is_direction_mark(character)) continue;
    if (is_blank(character)) {
      if (!result.empty() && result.back() != U' ') result += U' ';
    } else {
      result += has_glyph(character) ? character : U'?';
    }
    if (result.size() > longest) {
      result.resize(longest);
      if (longest > 0) result.back() = U'…';
      break;
    }
  }
  while (!result.empty() && result.back() == U' ') result.pop_back();
  return result;
}

std::u32string number_text(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return drawable(text);
}

std::u32string count_text(std::size_t count, std::size_t digits) {
  constexpr char32_t kBlankDigit = U'\u2007';
  std::u32string text = drawable(std::to_string(count));
  if (text.size() < digits) text.insert(0, digits - text.size(), kBlankDigit);
  return text;
}

}  // namespace ghtrack::render

#pragma once

#include <utf8.h>

#include <cstddef>
#include <optional>
#include <string_view>

namespace ghtrack::schema {

/// One character of a text.
struct Utf8Character {
  char32_t code = 0;
  std::size_t size = 0;  // in bytes
};

/// The first character of a text that is not empty; nothing if its bytes are not UTF-8: overlong,
/// cut off, a surrogate or beyond U+10FFFF.
inline std::optional<Utf8Character> first_character(std::string_view text) {
  if (const auto lead = static_cast<unsigned char>(text[0]); lead < 0x80) {
    return Utf8Character{lead, 1};
  }
  try {
    auto end = text.begin();
    const char32_t code = utf8::next(end, text.end());
    return Utf8Character{code, static_cast<std::size_t>(end - text.begin())};
  } catch (const utf8::exception&) {
    return std::nullopt;
  }
}

/// Does the character act on a terminal instead of showing?
constexpr bool is_control(char32_t code) { return code < 0x20 || (code >= 0x7F && code < 0xA0); }

}  // namespace ghtrack::schema

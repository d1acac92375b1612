#include "scenes/schema/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace ghtrack::schema {
namespace {

/// "1e6" and "1e-9" rather than "1e+06" and "1e-09".
std::string readable(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  const std::size_t sign = exponent + 1;
  const std::size_t digits = std::min(text.find_first_not_of('0', sign + 1), text.size() - 1);
  text.erase(sign + 1, digits - sign - 1);
  if (text[sign] == '+') text.erase(sign, 1);
  return text;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "010" is 8 to some readers and 10 to others.
bool has_leading_zero(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return text.size() > 1 && text[0] == '0' && is_digit(text[1]);
}

#ifdef __cpp_lib_to_chars
/// The number that makes up the whole text.
std::errc real_number(std::string_view text, double& value) {
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ptr == end ? result.ec : std::errc::invalid_argument;
}
#else
/// The same where the standard library has no std::from_chars() for it yet, as that for
/// WebAssembly.
std::errc real_number(std::string_view text, double& value) {
  if (text.find_first_not_of("+-.0123456789eE") != text.npos || text.starts_with('+')) {
    return std::errc::invalid_argument;
  }
  const std::string copy(text);
  char* end = nullptr;
  value = std::strtod(copy.c_str(), &end);
  if (copy.empty() || end != copy.c_str() + copy.size()) return std::errc::invalid_argument;
  return std::isfinite(value) ? std::errc() : std::errc::result_out_of_range;
}
#endif

}  // namespace

std::string shortest(double value) {
  std::array<char, 64> buffer{};
  constexpr double kPlainUpTo = 1e15;
  const bool plain = std::abs(value) < kPlainUpTo && value == std::trunc(value);
  const auto result = plain ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                            std::chars_format::fixed)
                            : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), result.ptr);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) {
    text.insert(exponent, ".0");
  }
  return text;
}

std::errc parse_real(std::string_view text, double& value) {
  if (has_leading_zero(text)) return std::errc::invalid_argument;
  const std::errc error = real_number(text, value);
  if (error == std::errc() && !std::isfinite(value)) return std::errc::invalid_argument;
  return error;
}

bool looks_like_other_than_text(std::string_view plain) {
  double value = 0.0;
  return plain == "true" || plain == "false" || parse_real(plain, value) == std::errc() ||
         has_leading_zero(plain);
}

bool is_allowed(double value, const FieldInfo& info) {
  return value >= info.minimum && value <= info.maximum && value > info.above && value < info.below;
}

std::string unit_suffix(const FieldInfo& info) {
  return info.unit.empty() || info.unit == "1" ? "" : fmt::format(" {}", info.unit);
}

std::string allowed_text(const FieldInfo& info) {
  const bool from = std::isfinite(info.minimum);
  const bool above = std::isfinite(info.above);
  const bool to = std::isfinite(info.maximum);
  const bool below = std::isfinite(info.below);
  std::string text;
  if (from && to) {
    text = fmt::format("from {} to {}", readable(info.minimum), readable(info.maximum));
  } else {
    if (above) text = fmt::format("above {}", readable(info.above));
    if (from) text = fmt::format("at least {}", readable(info.minimum));
    if (!text.empty() && (to || below)) text += " and ";
    if (to) text += fmt::format("at most {}", readable(info.maximum));
    if (below) text += fmt::format("below {}", readable(info.below));
  }
  return text.empty() ? text : text + unit_suffix(info);
}

}  // namespace ghtrack::schema

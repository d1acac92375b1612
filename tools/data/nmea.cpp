#include "tools/data/nmea.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

/// Where the fields of a sentence are; the field behind a coordinate says on which side it is.
struct Layout {
  std::string_view kind;
  std::size_t time, state, latitude, longitude, date;  // 0: there is no such
  std::string_view unknown;                            // states without a place
};
constexpr Layout kLayouts[] = {
    {"RMC", 1, 2, 3, 5, 9, "V"}, {"GGA", 1, 6, 2, 4, 0, "0"}, {"GLL", 5, 6, 1, 3, 0, "V"}};

bool are_digits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// "093015.00" → "09:30:15.00"; empty if it is none.
std::string time_of(std::string_view field) {
  const std::size_t point = std::min(field.find('.'), field.size());
  if (point != 6 || !are_digits(field.substr(0, 6))) return {};
  return fmt::format("{}:{}:{}", field.substr(0, 2), field.substr(2, 2), field.substr(4));
}

/// "110624" → "2024-06-11 "; empty if it is none. Receivers of GPS count from 1980.
std::string date_of(std::string_view field) {
  if (field.size() != 6 || !are_digits(field)) return {};
  return fmt::format("{}{}-{}-{} ", field[4] < '8' ? "20" : "19", field.substr(4, 2),
                     field.substr(2, 2), field.substr(0, 2));
}

/// A coordinate and the side in the field behind it.
std::optional<double> coordinate(std::string_view number, std::string_view side,
                                 std::string_view positive, std::string_view negative) {
  const auto value = parse_number(number);
  const auto degrees = value ? degrees_of_minutes(*value) : std::nullopt;
  if (!degrees || (side != positive && side != negative)) return std::nullopt;
  return side == negative ? -*degrees : *degrees;
}

/// The hexadecimal number of two digits behind the asterisk, if there is one.
std::optional<unsigned> said_sum(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  unsigned sum = 0;
  if (text.size() != 2) return std::nullopt;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(static_cast<char>(c >= 'a' ? c - 'a' + 'A' : c));
    if (digit == std::string_view::npos) return std::nullopt;
    sum = 16 * sum + static_cast<unsigned>(digit);
  }
  return sum;
}

}  // namespace

bool is_nmea(std::string_view line) {
  return line.size() > 6 && (line[0] == '$' || line[0] == '!') && line[6] == ',' &&
         std::all_of(line.begin() + 1, line.begin() + 6,
                     [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}

std::optional<double> degrees_of_minutes(double ddmm) {
  const double whole = std::trunc(ddmm / 100.0);
  const double minutes = ddmm - 100.0 * whole;
  if (std::abs(minutes) >= 60.0) return std::nullopt;
  return whole + minutes / 60.0;
}

std::optional<NmeaFix> parse_nmea(std::string_view line) {
  if (!is_nmea(line) || line[0] != '$') return std::nullopt;
  while (line.ends_with(' ') || line.ends_with('\r')) line.remove_suffix(1);
  const auto layout = std::find_if(std::begin(kLayouts), std::end(kLayouts),
                                   [&](const Layout& l) { return l.kind == line.substr(3, 3); });
  if (layout == std::end(kLayouts)) return std::nullopt;
  NmeaFix fix{.kind = std::string(layout->kind)};
  const std::size_t star = std::min(line.find('*'), line.size());
  if (star < line.size()) {
    std::uint8_t sum = 0;
    for (const char c : line.substr(1, star - 1)) sum ^= static_cast<std::uint8_t>(c);
    if (said_sum(line.substr(star + 1)) != sum) {
      fix.fault = fmt::format("a sentence with the checksum {} instead of {:02X}",
                              line.substr(star + 1), sum);
      return fix;
    }
  }
  std::vector<std::string_view> fields;
  for (std::string_view rest = line.substr(0, star);;) {
    const std::size_t end = rest.find(',');
    fields.push_back(rest.substr(0, end));
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  const std::size_t last =
      std::max({layout->time, layout->state, layout->longitude + 1, layout->date});
  if (fields.size() <= last) {
    fix.fault = fmt::format("a sentence with {} fields", fields.size());
    return fix;
  }
  const std::string time = time_of(fields[layout->time]);
  const std::string date = layout->date > 0 ? date_of(fields[layout->date]) : std::string();
  if (fields[layout->time].empty() || (layout->date > 0 && fields[layout->date].empty())) {
    return std::nullopt;
  }
  if (time.empty() || (layout->date > 0 && date.empty())) {
    fix.fault = "a sentence without a time as hhmmss";
    return fix;
  }
  fix.time = date + time;
  const std::string_view state = fields[layout->state];
  if (state.empty() || state == layout->unknown) return fix;
  const auto latitude =
      coordinate(fields[layout->latitude], fields[layout->latitude + 1], "N", "S");
  const auto longitude =
      coordinate(fields[layout->longitude], fields[layout->longitude + 1], "E", "W");
  if (latitude && longitude) {
    fix.place = {.latitude = *latitude, .longitude = *longitude};
  } else {
    fix.fault = "a sentence whose place is none as ddmm.mmmm";
  }
  return fix;
}

}  // namespace ghtrack

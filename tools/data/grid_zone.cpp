#include "tools/data/grid_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace ghtrack {
namespace {

/// The number of a zone and the half of the earth: of 32V, the north. Letters are bands of 8°, of
/// which the southern ones are C to M, or N and S themselves.
struct Zone {
  std::string_view number;
  char letter = '\0';
};

Zone parse_zone(std::string_view text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
  const std::size_t letter = text.find_first_not_of(" ", end);
  std::string_view number = text.substr(0, end);
  while (number.size() > 1 && number.front() == '0') number.remove_prefix(1);
  const char c = letter < text.size() ? text[letter] : '\0';
  return {number, static_cast<char>(std::toupper(static_cast<unsigned char>(c)))};
}

bool is_same(const Zone& a, const Zone& b) {
  if (a.number != b.number) return false;
  if (a.letter == '\0' || b.letter == '\0' || a.letter == b.letter) return true;
  const bool are_halves =
      std::min(a.letter, b.letter) == 'N' && std::max(a.letter, b.letter) == 'S';
  return !are_halves && (a.letter < 'N') == (b.letter < 'N');
}

}  // namespace

std::optional<GridZone> GridZone::find(const Table& table) {
  if (!table.columns().has_plane()) return std::nullopt;
  for (const char* name :
       {"zone", "utm_zone", "utmzone", "zone_utm", "utm_zone_number", "grid_zone", "zone_number"}) {
    if (const auto column = table.column_with_base(name)) return GridZone(*column);
  }
  return std::nullopt;
}

void GridZone::check(Table& table) {
  const std::string_view cell = table.cell(column_);
  if (is_missing(cell)) return;
  if (line_ == 0) {
    first_ = cell;
    line_ = table.line();
  }
  if (is_same(parse_zone(cell), parse_zone(first_))) return;
  table.reject_cell(column_, fmt::format("the zone of line {}, {}; places of two zones are in no "
                                         "common plane: take latitude and longitude",
                                         line_, in_quotes(first_)));
}

}  // namespace ghtrack

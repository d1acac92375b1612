#include "tools/render/object_colors.hpp"

#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>

#include "tools/render/palette.hpp"

namespace ghtrack::render {

namespace {

constexpr std::size_t kColors = std::tuple_size_v<decltype(Theme::tracks)>;

/// What people call the colours of the palette; the better match first.
constexpr std::array<std::pair<std::string_view, std::size_t>, 17> kWords{{{"red", 7},
                                                                           {"red", 5},
                                                                           {"orange", 0},
                                                                           {"orange", 5},
                                                                           {"yellow", 3},
                                                                           {"green", 2},
                                                                           {"green", 8},
                                                                           {"blue", 1},
                                                                           {"blue", 6},
                                                                           {"violet", 9},
                                                                           {"purple", 9},
                                                                           {"pink", 4},
                                                                           {"magenta", 4},
                                                                           {"brown", 10},
                                                                           {"turquoise", 11},
                                                                           {"teal", 11},
                                                                           {"cyan", 11}}};

/// Whether it is among the words of a name.
bool has_word(std::string_view name, std::string_view word) {
  std::string letters = " ";
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_letter = std::isalpha(byte) != 0 || byte >= 0x80;
    letters += is_letter ? static_cast<char>(std::tolower(byte)) : ' ';
  }
  letters += ' ';
  return letters.find(' ' + std::string(word) + ' ') != std::string::npos;
}

}  // namespace

std::map<ObjectId, std::size_t> object_colors(const std::vector<ObjectInfo>& objects) {
  std::map<ObjectId, std::size_t> colors;
  std::array<bool, kColors> is_taken{};
  const auto take = [&](const ObjectInfo& object, std::size_t color) {
    colors[object.id] = color;
    is_taken[color] = true;
  };
  for (const ObjectInfo& object : objects) {
    for (const auto& [word, color] : kWords) {
      if (is_taken[color] || !has_word(object.name, word)) continue;
      take(object, color);
      break;
    }
  }
  for (const ObjectInfo& object : objects) {
    if (colors.contains(object.id)) continue;
    const std::size_t own = static_cast<std::size_t>(object.id) % kColors;
    std::size_t free = own;
    for (std::size_t i = 0; i < kColors && is_taken[free]; ++i) free = (free + 1) % kColors;
    take(object, is_taken[free] ? own : free);
  }
  return colors;
}

}  // namespace ghtrack::render

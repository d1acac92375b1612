#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace ghtrack::render {

/// An sRGB colour.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Color&) const = default;
};

/// A colour between two: `share` 0 gives the first, 1 the second.
constexpr Color mix(Color first, Color second, double share) {
  const auto between = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(from + share * (to - from) + 0.5);
  };
  return {between(first.red, second.red), between(first.green, second.green),
          between(first.blue, second.blue)};
}

/// Contrast ratio of two colours, 1 to 21; text wants 4.5, graphics 3 (WCAG 2.1, section 1.4).
inline double contrast(Color first, Color second) {
  const auto linear = [](std::uint8_t channel) {
    const double value = channel / 255.0;
    return value <= 0.03928 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  const auto luminance = [&](Color color) {
    return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
  };
  const double a = luminance(first);
  const double b = luminance(second);
  return (std::fmax(a, b) + 0.05) / (std::fmin(a, b) + 0.05);
}

/// The colours of a picture: what is drawn in no colour, and those that tell tracks apart.
struct Theme {
  Color page, world, minor_grid, major_grid, axis_text;
  Color ground, ground_line, rail, tie;
  Color field_of_view, wind;
  Color truth, truth_edge;
  Color detection, clutter, tentative;
  Color text, muted_text;
  std::array<Color, 12> tracks;

  /// Of the object, or filter, with that index: the same during a whole run. After the twelfth they
  /// come again.
  constexpr Color track(int index) const {
    const int count = static_cast<int>(tracks.size());
    return tracks[static_cast<std::size_t>((index % count + count) % count)];
  }
};

/// For screens. The first seven colours are those that people with any kind of colour vision tell
/// apart (Okabe & Ito 2008), without black and with a lighter blue, which show on the dark ground.
inline constexpr Theme kDark{
    .page = {11, 14, 19},
    .world = {17, 22, 29},
    .minor_grid = {24, 31, 40},
    .major_grid = {40, 50, 62},
    .axis_text = {128, 140, 155},
    .ground = {31, 28, 25},
    .ground_line = {122, 106, 86},
    .rail = {58, 68, 81},
    .tie = {98, 110, 125},
    .field_of_view = {92, 118, 142},
    .wind = {60, 90, 112},
    .truth = {70, 80, 93},
    .truth_edge = {190, 200, 212},
    .detection = {255, 255, 255},
    .clutter = {122, 131, 143},
    .tentative = {148, 157, 168},
    .text = {232, 237, 243},
    .muted_text = {154, 166, 180},
    .tracks = {{{230, 159, 0},
                {86, 180, 233},
                {0, 158, 115},
                {240, 228, 66},
                {204, 121, 167},
                {222, 104, 10},
                {58, 134, 255},
                {255, 105, 105},
                {161, 214, 98},
                {156, 140, 255},
                {196, 154, 108},
                {94, 225, 213}}},
};

/// For paper and bright rooms: the same hues, dark enough for a white ground.
inline constexpr Theme kLight{
    .page = {255, 255, 255},
    .world = {255, 255, 255},
    .minor_grid = {243, 245, 247},
    .major_grid = {223, 228, 233},
    .axis_text = {92, 102, 113},
    .ground = {236, 232, 224},
    .ground_line = {133, 113, 88},
    .rail = {188, 196, 205},
    .tie = {120, 131, 143},
    .field_of_view = {94, 118, 142},
    .wind = {150, 178, 200},
    .truth = {214, 220, 227},
    .truth_edge = {48, 56, 66},
    .detection = {20, 24, 30},
    .clutter = {134, 143, 154},
    .tentative = {110, 119, 130},
    .text = {20, 24, 30},
    .muted_text = {82, 92, 103},
    .tracks = {{{160, 96, 0},
                {18, 110, 172},
                {0, 122, 87},
                {118, 105, 0},
                {171, 66, 124},
                {190, 70, 0},
                {0, 82, 147},
                {196, 56, 76},
                {66, 118, 12},
                {99, 78, 208},
                {133, 92, 48},
                {0, 118, 128}}},
};

}  // namespace ghtrack::render

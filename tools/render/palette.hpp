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

// The colours that people with any kind of colour vision tell apart (Okabe & Ito 2008), without
// black, which does not show on the dark ground, and with a lighter blue for the same reason.
inline constexpr Color kOrange{230, 159, 0};
inline constexpr Color kSkyBlue{86, 180, 233};
inline constexpr Color kBluishGreen{0, 158, 115};
inline constexpr Color kYellow{240, 228, 66};
inline constexpr Color kBlue{0, 114, 178};
inline constexpr Color kVermillion{213, 94, 0};
inline constexpr Color kReddishPurple{204, 121, 167};

inline constexpr std::array<Color, 7> kTrackColors{
    kOrange, kSkyBlue, kBluishGreen, kYellow, kReddishPurple, kVermillion, kBlue};

/// The colour of a track, or of a compared filter: the same during a whole run.
constexpr Color track_color(int id) {
  const int count = static_cast<int>(kTrackColors.size());
  return kTrackColors[static_cast<std::size_t>(((id - 1) % count + count) % count)];
}

/// The dark ground on which videos are drawn, and what is drawn on it in no colour.
namespace dark {
inline constexpr Color kPage{11, 14, 19};
inline constexpr Color kWorld{17, 22, 29};
inline constexpr Color kMinorGrid{24, 31, 40};
inline constexpr Color kMajorGrid{40, 50, 62};
inline constexpr Color kAxisText{128, 140, 155};
inline constexpr Color kGround{31, 28, 25};
inline constexpr Color kGroundLine{122, 106, 86};
inline constexpr Color kRail{58, 68, 81};
inline constexpr Color kTie{98, 110, 125};
inline constexpr Color kFieldOfView{62, 82, 102};
inline constexpr Color kWind{60, 90, 112};
inline constexpr Color kTruth{70, 80, 93};
inline constexpr Color kTruthEdge{190, 200, 212};
inline constexpr Color kDetection{255, 255, 255};
inline constexpr Color kClutter{122, 131, 143};
inline constexpr Color kTentative{148, 157, 168};
inline constexpr Color kText{232, 237, 243};
inline constexpr Color kMutedText{154, 166, 180};
}  // namespace dark

}  // namespace ghtrack::render

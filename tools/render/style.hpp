#pragma once

#include <algorithm>
#include <cmath>

#include "tools/render/font.hpp"
#include "tools/render/palette.hpp"

namespace ghtrack::render {

/// The typefaces of a picture.
struct Typefaces {
  Font regular{Font::Weight::kRegular};
  Font bold{Font::Weight::kBold};
};

inline constexpr double kPlate = 0.62;  // opacity of the ground behind a label

/// Colours, and sizes that grow with the picture: all are given for 1280 × 720 pixels.
struct Style {
  double unit = 1.0;  // [px] of this picture per pixel of one with 1280 × 720
  double text = 1.0;  // how much larger letters are than usual
  const Theme* colors = &kDark;

  static Style of_picture(int width, int height) {
    return {std::max(0.5, std::min(width / 1280.0, height / 720.0))};
  }

  const Theme& theme() const { return *colors; }

  double length(double pixels) const { return pixels * unit; }
  /// Of what holds letters, which must not be lower than they are.
  double room(double pixels) const { return length(pixels) * std::max(1.0, text); }
  int letters(double pixels) const {
    return std::max(7, static_cast<int>(std::lround(pixels * unit * text)));
  }
};

}  // namespace ghtrack::render

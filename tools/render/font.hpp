#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ghtrack::render {

/// One letter at one size: how much of each pixel it covers.
struct Glyph {
  cv::Mat coverage;  // 8 bit; empty for a blank
  int left = 0;      // of the coverage's first column from the pen [px]
  int top = 0;       // of its first row above the baseline [px]
  int advance = 0;   // of the pen [px]
};

/// A typeface whose letters are drawn once and kept. DejaVu Sans, as Debian's OpenCV brings it
/// along; Hershey's strokes, which are part of OpenCV, where it is missing.
class Font {
 public:
  enum class Weight { kRegular, kBold };
  explicit Font(Weight weight);
  ~Font();

  /// @param height of the letters, about that of "Ag" [px]
  const Glyph& glyph(char32_t character, int height) const;

  int width(std::u32string_view text, int height) const;  // [px]

  /// As much of the text as fits, with "…" where it was cut.
  std::u32string fitted(std::u32string text, int height, int width) const;

 private:
  class Face;
  std::unique_ptr<Face> face_;
  mutable std::map<std::pair<char32_t, int>, Glyph> glyphs_;
};

}  // namespace ghtrack::render

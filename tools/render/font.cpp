#include "tools/render/font.hpp"

#include <opencv2/core.hpp>
#include <opencv2/freetype.hpp>
#include <opencv2/imgproc.hpp>

#include <utf8.h>

#include <iterator>

namespace ghtrack::render {

namespace {

constexpr const char* kFontFolder = "/usr/share/fonts/truetype/dejavu/";
constexpr double kHersheyHeight = 30.0;  // [px] of "Ag" at scale 1

std::string as_utf8(char32_t character) {
  std::string text;
  utf8::append(character, std::back_inserter(text));
  return text;
}

}  // namespace

/// Where the letters come from.
class Font::Face {
 public:
  explicit Face(Weight weight) : bold_(weight == Weight::kBold) {
    const std::string file =
        std::string(kFontFolder) + (bold_ ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf");
    if (!std::filesystem::exists(file)) return;
    outlines_ = cv::freetype::createFreeType2();
    outlines_->loadFontData(file, 0);
  }

  void draw(cv::Mat& image, char32_t character, cv::Point pen, int height) const {
    const cv::Scalar white(255, 255, 255);
    if (outlines_)
      outlines_->putText(image, as_utf8(character), pen, height, white, -1, cv::LINE_AA, true);
    else
      cv::putText(image, strokes(character), pen, cv::FONT_HERSHEY_SIMPLEX, height / kHersheyHeight,
                  white, bold_ ? 2 : 1, cv::LINE_AA);
  }

  /// The pen's way over one letter: what it adds between two others.
  int advance(char32_t character, int height) const {
    const std::string letter = outlines_ ? as_utf8(character) : strokes(character);
    return width(std::string("|").append(letter).append("|"), height) - width("||", height);
  }

 private:
  /// What Hershey's font has for a character.
  static std::string strokes(char32_t character) {
    switch (character) {
      case U'\u2007':  // a blank as wide as a digit
      case U'\u00A0':
        return " ";
      case U'−':
        return "-";
      case U'×':
        return "x";
      case U'…':
        return ".";
      default:
        return {character < 0x80 ? static_cast<char>(character) : '?'};
    }
  }

  int width(const std::string& text, int height) const {
    int baseline = 0;
    return outlines_ ? outlines_->getTextSize(text, height, -1, &baseline).width
                     : cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, height / kHersheyHeight,
                                       bold_ ? 2 : 1, &baseline)
                           .width;
  }

  bool bold_;
  cv::Ptr<cv::freetype::FreeType2> outlines_;
};

Font::Font(Weight weight) : face_(std::make_unique<Face>(weight)) {}
Font::~Font() = default;

const Glyph& Font::glyph(char32_t character, int height) const {
  const auto [entry, is_new] = glyphs_.try_emplace({character, height});
  Glyph& glyph = entry->second;
  if (!is_new) return glyph;
  glyph.advance = face_->advance(character, height);
  const int margin = 2 * height;
  cv::Mat image = cv::Mat::zeros(2 * margin, 2 * margin + glyph.advance, CV_8UC3);
  face_->draw(image, character, {margin, margin}, height);
  cv::Mat coverage;
  cv::extractChannel(image, coverage, 0);
  const cv::Rect ink = cv::boundingRect(coverage);
  if (ink.empty()) return glyph;
  glyph.coverage = coverage(ink).clone();
  glyph.left = ink.x - margin;
  glyph.top = margin - ink.y;
  return glyph;
}

int Font::width(std::u32string_view text, int height) const {
  int width = 0;
  for (const char32_t character : text) width += glyph(character, height).advance;
  return width;
}

std::u32string Font::fitted(std::u32string text, int height, int width) const {
  if (this->width(text, height) <= width) return text;
  while (!text.empty() && this->width(text + U"…", height) > width) text.pop_back();
  return text + U"…";
}

}  // namespace ghtrack::render

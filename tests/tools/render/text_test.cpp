#include "tools/render/text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace ghtrack::render {
namespace {

// Property: what the font has is kept as it is.
TEST(DrawableText, KeepsMarkupAndLettersWithAccents) {
  EXPECT_EQ(drawable("<b>Zug & Ball</b>"), U"<b>Zug & Ball</b>");
  EXPECT_EQ(drawable("Ägypten σ = 0.3 m²"), U"Ägypten σ = 0.3 m²");
}

// Property: what cannot be shown becomes "?", what only steers the writing is left out.
TEST(DrawableText, ReplacesWhatTheFontDoesNotHave) {
  EXPECT_EQ(drawable("电车 7"), U"?? 7");
  EXPECT_EQ(drawable("שלום"), U"????");
  EXPECT_EQ(drawable("\xE2\x80\xAE"
                     "ball"
                     "\xE2\x80\xAC"),
            U"ball");
  EXPECT_EQ(drawable("\xF0\x9F\x9A\x82"), U"?");
}

// Property: control characters and line breaks are blanks, never two in a row.
TEST(DrawableText, TurnsControlCharactersIntoSingleBlanks) {
  EXPECT_EQ(drawable("a\n\t\x1b[31mb"), U"a [31mb");
  EXPECT_EQ(drawable("  a  "), U"a");
  EXPECT_EQ(drawable(std::string("a\0b", 3)), U"a b");
}

// Property: bytes that are not UTF-8 never end the text or read beyond it.
TEST(DrawableText, SurvivesBrokenUtf8) {
  EXPECT_EQ(drawable("a\xFFz"), U"a?z");
  EXPECT_EQ(drawable("a\xC3"), U"a?");
  EXPECT_EQ(drawable("\xC0\xAF"), U"??");             // overlong
  EXPECT_EQ(drawable("\xED\xA0\x80").front(), U'?');  // a surrogate
  for (int byte = 0; byte < 256; ++byte)
    EXPECT_LE(drawable(std::string(3, static_cast<char>(byte))).size(), 3u);
}

// Property: long texts are cut, and say so.
TEST(DrawableText, CutsLongTexts) {
  const std::u32string text = drawable(std::string(4000, 'x'), 50);
  EXPECT_EQ(text.size(), 50u);
  EXPECT_EQ(text.back(), U'…');
}

}  // namespace
}  // namespace ghtrack::render

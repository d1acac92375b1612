#include "tools/render/palette.hpp"

#include <gtest/gtest.h>

namespace ghtrack::render {
namespace {

// Derived: WCAG 2.1 defines 21 for black and white and 1 for equal colours.
TEST(Contrast, IsOneForEqualColoursAndTwentyOneForBlackAndWhite) {
  EXPECT_NEAR(contrast({0, 0, 0}, {255, 255, 255}), 21.0, 1e-12);
  EXPECT_NEAR(contrast(kDark.text, kDark.text), 1.0, 1e-12);
}

// Property: graphics need a contrast of 3 with their ground, text needs 4.5 (WCAG 2.1); names are
// written in the colours of their tracks.
TEST(Palette, StandsOutFromTheGround) {
  for (const Theme* theme : {&kDark, &kLight}) {
    for (const Color color : theme->tracks) {
      EXPECT_GE(contrast(color, theme->world), 4.5);
      EXPECT_GE(contrast(color, theme->page), 4.5);
    }
    for (const Color color :
         {theme->truth_edge, theme->detection, theme->clutter, theme->tentative}) {
      EXPECT_GE(contrast(color, theme->world), 3.0);
    }
    for (const Color color : {theme->text, theme->muted_text, theme->axis_text}) {
      EXPECT_GE(contrast(color, theme->page), 4.5);
    }
  }
}

// Property: labels are written in the track's colour, mixed with a third of that of detections.
TEST(Palette, KeepsLabelsLegible) {
  for (const Theme* theme : {&kDark, &kLight}) {
    for (const Color color : theme->tracks) {
      EXPECT_GE(contrast(mix(color, theme->detection, 0.35), theme->world), 4.5);
    }
  }
}

// Property: the colour of an object depends on its index alone, for every index, and no two of the
// palette are the same.
TEST(Palette, GivesNeighboursDifferentColours) {
  for (const Theme* theme : {&kDark, &kLight}) {
    for (int i = -20; i < 40; ++i) EXPECT_FALSE(theme->track(i) == theme->track(i + 1)) << i;
    const int count = static_cast<int>(theme->tracks.size());
    EXPECT_EQ(theme->track(3), theme->track(3 + count));
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < i; ++k) EXPECT_FALSE(theme->track(i) == theme->track(k)) << i << " " << k;
    }
  }
}

}  // namespace
}  // namespace ghtrack::render

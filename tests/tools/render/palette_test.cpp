#include "tools/render/palette.hpp"

#include <gtest/gtest.h>

namespace ghtrack::render {
namespace {

// Derived: WCAG 2.1 defines 21 for black and white and 1 for equal colours.
TEST(Contrast, IsOneForEqualColoursAndTwentyOneForBlackAndWhite) {
  EXPECT_NEAR(contrast({0, 0, 0}, {255, 255, 255}), 21.0, 1e-12);
  EXPECT_NEAR(contrast(kOrange, kOrange), 1.0, 1e-12);
}

// Property: graphics need a contrast of 3 with their ground, text needs 4.5 (WCAG 2.1).
TEST(Palette, StandsOutFromTheGround) {
  for (const Color color : kTrackColors) EXPECT_GE(contrast(color, dark::kWorld), 3.0);
  for (const Color color : {dark::kTruthEdge, dark::kDetection, dark::kClutter, dark::kTentative})
    EXPECT_GE(contrast(color, dark::kWorld), 3.0);
  for (const Color color : {dark::kText, dark::kMutedText, dark::kAxisText})
    EXPECT_GE(contrast(color, dark::kPage), 4.5);
}

// Property: labels are written in the track's colour, lightened by a quarter.
TEST(Palette, KeepsLabelsLegible) {
  for (const Color color : kTrackColors)
    EXPECT_GE(contrast(mix(color, dark::kDetection, 0.25), dark::kWorld), 4.5);
}

// Property: the colour of a track depends on its id alone, for every id.
TEST(Palette, GivesNeighbouringTracksDifferentColours) {
  for (int id = -20; id < 40; ++id) EXPECT_FALSE(track_color(id) == track_color(id + 1)) << id;
  EXPECT_EQ(track_color(3), track_color(3 + static_cast<int>(kTrackColors.size())));
}

}  // namespace
}  // namespace ghtrack::render

#include "tools/render/label_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ghtrack::render {
namespace {

constexpr Viewport kArea{0.0, 0.0, 1280.0, 640.0};

LabelRequest label(int id, double x, double y) { return {id, {x, y}, 12.0, 120.0, 20.0}; }

// Property: labels of a crowd overlap neither each other nor the edge of the picture.
TEST(LabelLayout, KeepsLabelsApartInACrowd) {
  LabelLayout layout;
  std::vector<LabelRequest> requests;
  for (int i = 0; i < 12; ++i)
    requests.push_back(label(i, 600.0 + 25.0 * (i % 4), 300.0 + 25.0 * (i / 4)));
  requests.push_back(label(20, 2.0, 2.0));
  requests.push_back(label(21, 1278.0, 638.0));
  const auto places = layout.place(requests, {}, kArea);
  ASSERT_EQ(places.size(), requests.size());
  int placed = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    ++placed;
    EXPECT_GE(places[i]->left, 0.0);
    EXPECT_LE(places[i]->right(), 1280.0);
    EXPECT_GE(places[i]->top, 0.0);
    EXPECT_LE(places[i]->bottom(), 640.0);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_EQ(places[k] ? overlap(*places[i], *places[k]) : 0.0, 0.0) << i << " and " << k;
  }
  EXPECT_GE(placed, 12);
}

// Property: while things move a little, labels keep their side and move as much.
TEST(LabelLayout, DoesNotJumpWhenThingsMoveALittle) {
  LabelLayout layout;
  auto before = layout.place({label(1, 600.0, 300.0), label(2, 640.0, 310.0)}, {}, kArea);
  for (int frame = 1; frame < 60; ++frame) {
    const double shift = std::sin(0.7 * frame);
    const auto after =
        layout.place({label(1, 600.0 + shift, 300.0), label(2, 640.0, 310.0 + shift)}, {}, kArea);
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(before[i] && after[i]);
      EXPECT_LT(std::hypot(after[i]->left - before[i]->left, after[i]->top - before[i]->top), 2.0);
    }
    before = after;
  }
}

// Property: a label leaves its place when something marked comes to lie there.
TEST(LabelLayout, MakesWayForWhatIsMarked) {
  LabelLayout layout;
  const Viewport first = *layout.place({label(1, 600.0, 300.0)}, {}, kArea)[0];
  const Viewport second = *layout.place({label(1, 600.0, 300.0)}, {{first}}, kArea)[0];
  EXPECT_EQ(overlap(first, second), 0.0);
}

// Property: where no label may lie, none lies, however crowded it is elsewhere.
TEST(LabelLayout, NeverEntersForbiddenPlaces) {
  LabelLayout layout;
  const Obstacle picture{{620.0, 0.0, 660.0, 640.0}, std::numeric_limits<double>::infinity()};
  std::vector<LabelRequest> requests;
  for (int i = 0; i < 12; ++i) requests.push_back(label(i, 600.0, 300.0 + i));
  for (const auto& place : layout.place(requests, {picture}, kArea))
    EXPECT_EQ(place ? overlap(*place, picture.box) : 0.0, 0.0);
}

// Property: no place, no label; a crowd beyond measure does not pile up.
TEST(LabelLayout, LeavesOutLabelsWithoutAPlace) {
  LabelLayout layout;
  const auto places = layout.place({label(1, 30.0, 20.0)}, {}, {0.0, 0.0, 60.0, 40.0});
  EXPECT_FALSE(places[0].has_value());
}

}  // namespace
}  // namespace ghtrack::render

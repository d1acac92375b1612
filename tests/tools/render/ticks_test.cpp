#include "tools/render/ticks.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace ghtrack::render {
namespace {

// Derived: the smallest of 1, 2, 5 times a power of ten that is large enough.
TEST(Ticks, AreMultiplesOfOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_step(0.7), 1.0);
  EXPECT_DOUBLE_EQ(round_step(1.1), 2.0);
  EXPECT_DOUBLE_EQ(round_step(2.0), 2.0);
  EXPECT_DOUBLE_EQ(round_step(30.0), 50.0);
  EXPECT_DOUBLE_EQ(round_step(0.06), 0.1);
  EXPECT_THAT(round_ticks(-1.0, 3.9, 5), ::testing::ElementsAre(-1.0, 0.0, 1.0, 2.0, 3.0));
}

// Property: axes without an extent have no ticks rather than endless ones.
TEST(Ticks, AreFewForAnyAxis) {
  EXPECT_TRUE(round_ticks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(round_ticks(0.0, std::numeric_limits<double>::infinity(), 5).empty());
  EXPECT_LE(round_ticks(1e9, 1e9 + 1.0, 5).size(), 11u);
}

// Derived: as many decimals as the step has.
TEST(Ticks, AreLabelledWithTheStepsDecimals) {
  EXPECT_EQ(tick_label(12.5, 0.5), U"12.5");
  EXPECT_EQ(tick_label(-20.0, 10.0), U"−20");
  EXPECT_EQ(tick_label(-1e-17, 0.2), U"0.0");
}

}  // namespace
}  // namespace ghtrack::render

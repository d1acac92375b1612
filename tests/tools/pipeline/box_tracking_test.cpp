#include "tools/pipeline/box_tracking.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace ghtrack {
namespace {

/// One person who walks to the right, unseen in some frames.
std::vector<MotRow> walk(int frames, const std::set<int>& unseen) {
  std::vector<MotRow> rows;
  for (int frame = 1; frame <= frames; ++frame) {
    if (unseen.contains(frame)) continue;
    rows.push_back(
        {.frame = frame, .left = 10.0 + 4.0 * frame, .top = 50.0, .width = 40.0, .height = 100.0});
  }
  return rows;
}

// Derived: a steady walk is a line: the boxes of the gap lie on it.
TEST(BoxTracking, FillsAGapAlongTheWay) {
  const std::vector<MotRow> rows = track_boxes({}, {}, walk(40, {21, 22, 23, 24, 25})).rows;
  ASSERT_EQ(rows.size(), 40U);
  for (int i = 0; i < 40; ++i) {
    const MotRow& row = rows[static_cast<std::size_t>(i)];
    EXPECT_EQ(row.frame, i + 1);
    EXPECT_EQ(row.id, 1);
    EXPECT_NEAR(row.left, 10.0 + 4.0 * (i + 1), 1.5);
    EXPECT_NEAR(row.width, 40.0, 1e-9);
  }
}

// Derived: 5 images are a longer gap than 4.
TEST(BoxTracking, LeavesLongGapsOpen) {
  const BoxOutputConfig output{.longest_gap = 4};
  EXPECT_EQ(track_boxes({}, output, walk(40, {21, 22, 23, 24, 25})).rows.size(), 35U);
  EXPECT_EQ(track_boxes({}, output, walk(40, {21, 22, 23, 24})).rows.size(), 40U);
}

// Derived: a steady walk goes on along its line, for as long as asked and as there are frames.
TEST(BoxTracking, WritesPredictedBoxesWhileATrackIsUnseenIfAsked) {
  std::vector<MotRow> detections = walk(30, {});
  detections.push_back({.frame = 36, .left = 900, .top = 5, .width = 40, .height = 90});
  EXPECT_EQ(track_boxes({}, {}, detections).rows.size(), 30U);
  const std::vector<MotRow> four = track_boxes({}, {.coast = 4}, detections).rows;
  ASSERT_EQ(four.size(), 34U);
  EXPECT_EQ(four.back().frame, 34);
  EXPECT_NEAR(four.back().left, 10.0 + 4.0 * 34, 1.0);
  EXPECT_EQ(track_boxes({}, {.coast = 50}, detections).rows.back().frame, 36);
}

// Derived: the fourth detection confirms; what came before is written or not.
TEST(BoxTracking, WritesTheTimeBeforeConfirmationIfAsked) {
  const BoxOutputConfig only_confirmed{.from_first_sight = false};
  EXPECT_EQ(track_boxes({}, {}, walk(10, {})).rows.size(), 10U);
  EXPECT_EQ(track_boxes({}, only_confirmed, walk(10, {})).rows.size(), 7U);
}

// Property: what is never confirmed is never written; ids have no holes.
TEST(BoxTracking, NumbersTheTracksThatAreWrittenFromOne) {
  std::vector<MotRow> rows = walk(20, {1, 2, 3, 4, 5, 6, 7, 8});
  rows.insert(rows.begin(), {.frame = 3, .left = 400, .top = 5, .width = 40, .height = 90});
  for (const MotRow& row : track_boxes({}, {}, rows).rows) {
    EXPECT_EQ(row.id, 1);
    EXPECT_GE(row.frame, 9);
  }
  EXPECT_TRUE(track_boxes({}, {}, {}).rows.empty());
}

}  // namespace
}  // namespace ghtrack

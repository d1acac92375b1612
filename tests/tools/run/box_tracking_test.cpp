#include "tools/run/box_tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
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

/// A crowd seen by a detector that misses, invents and doubts.
std::vector<MotRow> crowd(int frames) {
  std::mt19937 random(12);
  std::normal_distribution<double> noise;
  std::uniform_real_distribution<double> unit;
  std::vector<MotRow> rows;
  const auto add = [&](int frame, double left, double top, double confidence) {
    MotRow row{.frame = frame, .left = left + 2.0 * noise(random), .top = top};
    row.width = 40.0 + 3.0 * noise(random);
    row.height = 95.0 + 4.0 * noise(random);
    row.confidence = confidence + 0.3 * noise(random);
    rows.push_back(row);
  };
  for (int frame = 1; frame <= frames; ++frame) {
    for (int person = 0; person < 8; ++person) {
      const bool is_hidden = (frame + 13 * person) % 40 < 6;
      if (is_hidden || unit(random) < 0.2) continue;
      const double pace = person % 2 == 0 ? 3.0 : -2.0;
      add(frame, 300.0 + 60.0 * person + pace * (frame % 150), 90.0 + 30.0 * person, 1.0);
    }
    if (unit(random) < 0.5) add(frame, 900.0 * unit(random), 400.0 * unit(random), 0.0);
  }
  return rows;
}

auto fields(const MotRow& row) {
  return std::tuple(row.frame, row.id, row.left, row.top, row.width, row.height);
}

using Frames = std::set<std::pair<std::int32_t, std::int64_t>>;

Frames frames_of(const std::vector<MotRow>& rows) {
  Frames frames;
  for (const MotRow& row : rows) frames.emplace(row.frame, row.id);
  return frames;
}

// Property: the default output is causal: what was written up to a frame is what would have been
// written had the sequence ended there.
TEST(BoxTracking, WritesNothingThatWasKnownLaterOnly) {
  const std::vector<MotRow> detections = crowd(200);
  const std::vector<MotRow> all = track_boxes({}, {}, detections).rows;
  for (const int last : {1, 2, 3, 17, 60, 61, 140}) {
    const auto end = std::find_if(detections.begin(), detections.end(),
                                  [&](const MotRow& row) { return row.frame > last; });
    const auto part = track_boxes({}, {}, std::vector<MotRow>(detections.begin(), end)).rows;
    ASSERT_LE(part.size(), all.size());
    for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(fields(part[i]), fields(all[i]));
    EXPECT_TRUE(part.size() == all.size() || all[part.size()].frame > last);
  }
}

/// The rows of tracks, and how many images were held in memory at most before one was handed on.
struct HandedOn {
  std::vector<MotRow> rows;
  std::int32_t longest_wait = 0;
};
HandedOn hand_on(const BoxOutputConfig& output, const std::vector<MotRow>& detections) {
  HandedOn result;
  std::int32_t read = 0;
  const auto source = [&, frames = ghtrack::frames_of(detections)] {
    const auto rows = frames();
    if (!rows.empty()) read = rows.front().frame;
    return rows;
  };
  track_boxes({}, output, source, [&](std::span<const MotRow> rows) {
    EXPECT_TRUE(result.rows.empty() || result.rows.back().frame < rows.front().frame);
    result.longest_wait = std::max(result.longest_wait, read - rows.front().frame);
    result.rows.insert(result.rows.end(), rows.begin(), rows.end());
  });
  return result;
}

// Property: by default the rows of an image are handed on with it; gaps that may be closed keep
// them back for so long, and filling as long as a track goes on, however many images there are.
TEST(BoxTracking, HoldsNoMoreThanMayChange) {
  for (const int frames : {300, 900}) {
    const std::vector<MotRow> detections = crowd(frames);
    EXPECT_EQ(hand_on({}, detections).longest_wait, 0);
    EXPECT_LE(hand_on({.longest_gap = 7}, detections).longest_wait, 8);
    EXPECT_LE(hand_on({.from_first_sight = true}, detections).longest_wait, 10);
    EXPECT_LE(hand_on({.fill = true}, detections).longest_wait, 250);  // a walk takes 150
  }
}

// Property: filling adds boxes and takes none away; a track has one box in a frame.
TEST(BoxTracking, FillingOnlyAdds) {
  const std::vector<MotRow> detections = crowd(200);
  const std::vector<MotRow> causal = track_boxes({}, {}, detections).rows;
  const std::vector<MotRow> filled = track_boxes({}, {.fill = true}, detections).rows;
  EXPECT_EQ(frames_of(causal).size(), causal.size());
  EXPECT_EQ(frames_of(filled).size(), filled.size());
  EXPECT_GT(filled.size(), causal.size());
  std::map<std::int32_t, int> in_causal, in_filled;
  for (const MotRow& row : causal) ++in_causal[row.frame];
  for (const MotRow& row : filled) ++in_filled[row.frame];
  for (const auto& [frame, count] : in_causal) EXPECT_GE(in_filled[frame], count) << frame;
}

// Property: the order of the rows within a frame carries no information.
TEST(BoxTracking, ShufflingTheRowsOfAFrameChangesNothing) {
  const std::vector<MotRow> detections = crowd(150);
  std::vector<MotRow> shuffled = detections;
  std::mt19937 random(5);
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  std::stable_sort(shuffled.begin(), shuffled.end(),
                   [](const MotRow& a, const MotRow& b) { return a.frame < b.frame; });
  const std::vector<MotRow> first = track_boxes({}, {}, detections).rows;
  const std::vector<MotRow> second = track_boxes({}, {}, shuffled).rows;
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(fields(first[i]), fields(second[i]));
}

// Property: confidences have any scale: 0 … 1, or real numbers that may be negative. (Powers of
// two, so that rounding is the same.)
TEST(BoxTracking, TheScaleOfTheConfidencesDoesNotMatter) {
  const std::vector<MotRow> detections = crowd(150);
  std::vector<MotRow> scaled = detections;
  for (MotRow& row : scaled) row.confidence = 64.0 * row.confidence;
  const std::vector<MotRow> first = track_boxes({}, {}, detections).rows;
  const std::vector<MotRow> second = track_boxes({}, {}, scaled).rows;
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(fields(first[i]), fields(second[i]));
}

// Derived: a box 40 wide that moves 45 to the right in every frame never overlaps with itself.
TEST(BoxTracking, FollowsABoxThatMovesFartherThanItsWidth) {
  std::vector<MotRow> detections;
  for (int frame = 1; frame <= 30; ++frame) {
    detections.push_back({.frame = frame, .left = 100.0 + 45.0 * frame, .top = 200.0});
    detections.back().width = 40.0, detections.back().height = 90.0;
  }
  const std::vector<MotRow> rows = track_boxes({}, {}, detections).rows;
  ASSERT_EQ(rows.size(), 30U);
  for (const MotRow& row : rows) EXPECT_EQ(row.id, 1);
}

// Derived: a steady walk is a line: the boxes of the gap lie on it.
TEST(BoxTracking, FillsAGapAlongTheWay) {
  const auto detections = walk(40, {21, 22, 23, 24, 25});
  EXPECT_EQ(track_boxes({}, {}, detections).rows.size(), 35U);
  const std::vector<MotRow> rows = track_boxes({}, {.fill = true}, detections).rows;
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

// Derived: predictions of one missed image have always come true, so the next one is believed.
TEST(BoxTracking, WritesPredictedBoxesOnceTheyHaveComeTrue) {
  const std::vector<MotRow> rows = track_boxes({}, {}, walk(60, {20, 30, 40})).rows;
  std::set<std::int32_t> frames;
  for (const MotRow& row : rows) frames.insert(row.frame);
  EXPECT_FALSE(frames.contains(20));
  EXPECT_TRUE(frames.contains(30));
  EXPECT_TRUE(frames.contains(40));
}

// Derived: what appears later than the first image is confirmed by its third detection; what came
// before is written or not.
TEST(BoxTracking, WritesTheTimeBeforeConfirmationIfAsked) {
  std::vector<MotRow> detections = walk(12, {});
  for (MotRow& row : detections) row.frame += 1;
  detections.insert(detections.begin(), {.frame = 1, .left = 900, .width = 40, .height = 90});
  const auto walker_rows = [&](const BoxOutputConfig& output) {
    const std::vector<MotRow> rows = track_boxes({}, output, detections).rows;
    return std::count_if(rows.begin(), rows.end(), [](const MotRow& row) { return row.id == 2; });
  };
  EXPECT_EQ(walker_rows({}), 10);
  EXPECT_EQ(walker_rows({.from_first_sight = true}), 12);
  EXPECT_EQ(walker_rows({.fill = true}), 12);
}

// Property: what is never confirmed is never written; ids have no holes.
TEST(BoxTracking, NumbersTheTracksThatAreWrittenFromOne) {
  std::vector<MotRow> rows = walk(20, {2, 3, 4, 5, 6, 7, 8});
  rows.erase(rows.begin());
  rows.insert(rows.begin(), {.frame = 3, .left = 400, .top = 5, .width = 40, .height = 90});
  rows.insert(rows.begin(), {.frame = 1, .left = 700, .top = 5, .width = 40, .height = 90});
  for (const MotRow& row : track_boxes({}, {}, rows).rows) {
    if (row.frame == 1) continue;
    EXPECT_EQ(row.id, 2);
    EXPECT_GE(row.frame, 9);
  }
  EXPECT_TRUE(track_boxes({}, {}, {}).rows.empty());
}

// Derived: what is said counts what was given.
TEST(BoxTracking, SaysWhatWasReadLearnedAndConfirmed) {
  const std::vector<MotRow> detections = walk(40, {21});
  const std::string line = summary({}, track_boxes({}, {}, detections));
  EXPECT_NE(line.find("39 boxes in 39 images, confidence 1.00 ± 0.00"), std::string::npos) << line;
  EXPECT_NE(line.find("1 track confirmed of 1 begun"), std::string::npos) << line;
  const BoxTrackerConfig strict{.acceleration = 0.01, .start_confidence = 2.0};
  const std::string none = summary(strict, track_boxes(strict, {}, detections));
  EXPECT_NE(none.find("0.0100 (given)"), std::string::npos) << none;
  EXPECT_NE(none.find("no track was confirmed of 0 begun"), std::string::npos) << none;
}

}  // namespace
}  // namespace ghtrack

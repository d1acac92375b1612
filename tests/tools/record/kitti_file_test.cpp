#include "tools/record/kitti_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "tests/tools/record/scratch_folder.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

using ::testing::HasSubstr;

constexpr const char* kLabels =
    "1 7 Car 0 0 -1.5 10.5 20 110.5 70 1.5 1.6 3.9 2 1.5 20 -1.6\n"
    "0 -1 DontCare -1 -1 -10 5 5 9 9 -1 -1 -1 -1000 -1000 -1000 -10\n"
    "0 7 Car 0 2 -1.5 10 20 110 70 1.5 1.6 3.9 2 1.5 20 -1.6 0.75\n";

std::vector<KittiRow> rows_of(KittiReader reader) {
  std::vector<KittiRow> rows;
  for (auto frame = reader.next(); !frame.empty(); frame = reader.next()) {
    rows.insert(rows.end(), frame.begin(), frame.end());
  }
  return rows;
}

// Derived: images and pixels that count from 0 there count from 1 here; what is not labelled is no
// object.
TEST(KittiFile, ReadsLabels) {
  const ScratchFolder folder;
  const auto path = folder.write("0000.txt", kLabels);
  EXPECT_TRUE(looks_like_kitti_file(path));
  EXPECT_TRUE(looks_like_mot_file(path));
  const auto all = rows_of(KittiReader(path, MotKind::kTruth));
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].type, kNotLabelled);
  EXPECT_EQ(all[0].box.left, 6.0);
  const std::span<const KittiRow> rows = std::span(all).subspan(1);
  EXPECT_EQ(rows[0].type, "Car");
  EXPECT_EQ(rows[0].box.frame, 1);
  EXPECT_EQ(rows[0].box.left, 11.0);
  EXPECT_EQ(rows[0].box.width, 100.0);
  EXPECT_EQ(rows[0].box.confidence, 0.75);
  EXPECT_EQ(rows[0].truncated, 0);
  EXPECT_EQ(rows[0].occluded, 2);
  EXPECT_EQ(rows[1].box.frame, 2);
  EXPECT_EQ(read_mot_file(path, MotKind::kTruth).size(), 2U);
}

// Property: what is written reads back.
TEST(KittiFile, WritesWhatItReads) {
  const ScratchFolder folder;
  const auto rows = rows_of(KittiReader(folder.write("a.txt", kLabels), MotKind::kResult));
  std::string text;
  for (const KittiRow& row : rows) append_kitti_row(text, row);
  const auto again = rows_of(KittiReader(folder.write("b.txt", text), MotKind::kResult));
  ASSERT_EQ(again.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(again[i].box.left, rows[i].box.left);
    EXPECT_EQ(again[i].box.height, rows[i].box.height);
    EXPECT_EQ(again[i].box.id, rows[i].box.id);
    EXPECT_EQ(again[i].type, rows[i].type);
  }
}

// Property: defects are named with their line.
TEST(KittiFile, NamesDefects) {
  const ScratchFolder folder;
  const auto path =
      folder.write("a.txt",
                   "0 7 Car 0 0 -1.5 10 20 110 70 1.5 1.6 3.9 2 1.5 20 -1.6\n"
                   "1 7 Car 0 0 -1.5 10 20 9 70 1.5 1.6 3.9 2 1.5 20 -1.6\n"
                   "2 7 Car 0 0 -1.5 10 oops 110 70 1.5 1.6 3.9 2 1.5 20 -1.6\n-1 7 Car\n");
  try {
    KittiReader(path, MotKind::kTruth);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(":2: error: the box from 10, 20 to 9, 70 has no area"));
    EXPECT_THAT(error.what(), HasSubstr(":3: error: 'oops' in field 8"));
    EXPECT_THAT(error.what(), HasSubstr(":4: error: 3 fields"));
  }
}

// Property: an object is there once in an image; regions that are not labelled may be many.
TEST(KittiFile, RefusesTwins) {
  const ScratchFolder folder;
  const std::string line = "3 7 Car 0 0 -1.5 10 20 110 70 1.5 1.6 3.9 2 1.5 20 -1.6\n";
  const std::string region = "3 -1 DontCare -1 -1 -10 5 5 9 9 -1 -1 -1 -1000 -1000 -1000 -10\n";
  const auto path = folder.write("a.txt", region + line + region + line);
  EXPECT_EQ(rows_of(KittiReader(path, MotKind::kDetections)).size(), 4U);
  try {
    rows_of(KittiReader(path, MotKind::kTruth));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr(":4: error: id 7 is there twice in frame 3; the first is in line 2"));
  }
}

}  // namespace
}  // namespace ghtrack

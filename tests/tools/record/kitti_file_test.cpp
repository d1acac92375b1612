#include "tools/record/kitti_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/record/scratch_folder.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

using ::testing::HasSubstr;

constexpr const char* kLabels =
    "1 7 Car 0 0 -1.5 10.5 20 110.5 70 1.5 1.6 3.9 2 1.5 20 -1.6\n"
    "0 -1 DontCare -1 -1 -10 5 5 9 9 -1 -1 -1 -1000 -1000 -1000 -10\n"
    "0 7 Car 0 2 -1.5 10 20 110 70 1.5 1.6 3.9 2 1.5 20 -1.6 0.75\n";

// Derived: images and pixels that count from 0 there count from 1 here; what is not labelled is no
// object.
TEST(KittiFile, ReadsLabels) {
  const ScratchFolder folder;
  const auto path = folder.write("0000.txt", kLabels);
  EXPECT_TRUE(looks_like_kitti_file(path));
  EXPECT_TRUE(looks_like_mot_file(path));
  const auto [rows, unlabelled] = read_kitti_file(path, MotKind::kTruth);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].type, "Car");
  EXPECT_EQ(rows[0].box.frame, 1);
  EXPECT_EQ(rows[0].box.left, 11.0);
  EXPECT_EQ(rows[0].box.width, 100.0);
  EXPECT_EQ(rows[0].box.confidence, 0.75);
  EXPECT_EQ(rows[0].truncated, 0);
  EXPECT_EQ(rows[0].occluded, 2);
  EXPECT_EQ(rows[1].box.frame, 2);
  ASSERT_EQ(unlabelled.size(), 1U);
  EXPECT_EQ(unlabelled[0].left, 6.0);
  EXPECT_EQ(read_mot_file(path, MotKind::kTruth).size(), 2U);
}

// Property: what is written reads back.
TEST(KittiFile, WritesWhatItReads) {
  const ScratchFolder folder;
  const auto rows = read_kitti_file(folder.write("a.txt", kLabels), MotKind::kResult).rows;
  std::string text;
  for (const KittiRow& row : rows) append_kitti_row(text, row);
  const auto again = read_kitti_file(folder.write("b.txt", text), MotKind::kResult).rows;
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
  const auto path = folder.write(
      "a.txt", "0 7 Car 0 0 -1.5 10 20 110 70 1.5 1.6 3.9 2 1.5 20 -1.6\n"
               "1 7 Car 0 0 -1.5 10 20 9 70 1.5 1.6 3.9 2 1.5 20 -1.6\n"
               "2 7 Car 0 0 -1.5 10 oops 110 70 1.5 1.6 3.9 2 1.5 20 -1.6\n-1 7 Car\n");
  try {
    read_kitti_file(path, MotKind::kTruth);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(":2: error: the box from 10, 20 to 9, 70 has no area"));
    EXPECT_THAT(error.what(), HasSubstr(":3: error: 'oops' in field 8"));
    EXPECT_THAT(error.what(), HasSubstr(":4: error: 3 fields"));
  }
}

}  // namespace
}  // namespace ghtrack

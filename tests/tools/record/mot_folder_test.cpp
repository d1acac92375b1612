#include "tools/record/mot_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/record/scratch_folder.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInfo =
    "[Sequence]\nname=street\nframeRate=25\nseqLength=9\nimWidth=640\nimHeight=480\n";

/// A sequence folder `street` with all its parts.
fs::path make_sequence(const ScratchFolder& folder) {
  const fs::path sequence = folder.path() / "street";
  fs::create_directories(sequence / "det");
  fs::create_directories(sequence / "gt");
  write_file(sequence / "det" / "det.txt", "1,-1,10,20,30,40,1\n");
  write_file(sequence / "gt" / "gt.txt", "1,1,10,20,30,40,1,-1,-1,-1\n");
  write_file(sequence / "seqinfo.ini", kInfo);
  return sequence;
}

// Derived: the parts of a sequence folder where MOTChallenge puts them.
TEST(MotSequence, IsFoundInItsFolder) {
  const ScratchFolder folder;
  const fs::path path = make_sequence(folder);
  for (const fs::path& name : {path, path / ""}) {
    const MotSequence sequence = open_mot_sequence(name);
    EXPECT_EQ(sequence.name, "street");
    EXPECT_TRUE(fs::exists(sequence.detections));
    EXPECT_TRUE(sequence.truth.has_value());
    ASSERT_TRUE(sequence.info.has_value());
    EXPECT_EQ(sequence.info->frame_rate, 25.0);
    EXPECT_EQ(sequence.info->width, 640);
  }
  const MotSequence file = open_mot_sequence(path / "det" / "det.txt");
  EXPECT_EQ(file.name, "det");
  EXPECT_FALSE(file.info.has_value());
}

// Derived: a folder without detections is no sequence.
TEST(MotSequence, NeedsDetections) {
  const ScratchFolder folder;
  EXPECT_THROW(open_mot_sequence(folder.path()), InputError);
}

// Derived: the layout that TrackEval reads by default.
TEST(EvaluationFolder, HasTheLayoutOfTrackEval) {
  const ScratchFolder folder;
  const MotSequence sequence = open_mot_sequence(make_sequence(folder));
  MotSequence without_truth = sequence;
  without_truth.name = "alley";
  without_truth.truth.reset();
  MotSequence without_info = sequence;
  without_info.name = "square";
  without_info.info_file.reset();
  EvaluationFolder evaluation({.root = folder.path() / "eval"});
  const auto add = [&](const MotSequence& added, const char* results, std::int32_t last_frame) {
    write_file(evaluation.results_of(added), results);
    evaluation.add(added, last_frame);
  };
  add(sequence, "1,1,10,20,30,40,1,-1,-1,-1\n", 1);
  add(without_truth, "", 1);
  add(without_info, "", 7);
  evaluation.finish();
  EXPECT_EQ(folder.read("eval/gt/seqmaps/MOT15-train.txt"), "name\nstreet\nsquare\n");
  EXPECT_EQ(folder.read("eval/gt/MOT15-train/street/gt/gt.txt"), "1,1,10,20,30,40,1,-1,-1,-1\n");
  EXPECT_EQ(folder.read("eval/gt/MOT15-train/street/seqinfo.ini"), kInfo);
  EXPECT_THAT(folder.read("eval/gt/MOT15-train/square/seqinfo.ini"),
              ::testing::HasSubstr("seqLength=7"));
  EXPECT_EQ(folder.read("eval/trackers/MOT15-train/ghtrack/data/street.txt"),
            "1,1,10,20,30,40,1,-1,-1,-1\n");
  EXPECT_EQ(folder.read("eval/trackers/MOT15-train/ghtrack/data/alley.txt"), "");
}

}  // namespace
}  // namespace ghtrack

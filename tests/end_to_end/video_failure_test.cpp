// What becomes of a video that cannot be completed: an exit code, one sentence, and nothing under
// its final name.

#include <gmock/gmock.h>
#include <sys/mount.h>

#include <algorithm>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string kVideo = "ghtrack video '" + scene_file("balloons.yaml").string() + "' ";

int line_count(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

struct Refused {
  std::string output;
  int exit_code;
  std::string says;
};

class Destination : public ::testing::TestWithParam<Refused> {};

// Derived: what cannot be a video's name is refused in one sentence, before anything is written.
TEST_P(Destination, IsRefusedInOneSentence) {
  const TemporaryFolder folder;
  const Outcome outcome = shell("mkdir folder && " + kVideo + GetParam().output, folder.path());
  EXPECT_EQ(outcome.exit_code, GetParam().exit_code) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().says));
  // A hint at the help may follow.
  EXPECT_EQ(line_count(outcome.err.substr(0, outcome.err.find("Try '"))), 1) << outcome.err;
  EXPECT_THAT(names_in(folder.path()), ElementsAre("folder"));
}

INSTANTIATE_TEST_SUITE_P(
    Video, Destination,
    ::testing::Values(Refused{"-o tcp://127.0.0.1:9/x.mp4", 2, "a file name consists of"},
                      Refused{"-o pipe:1", 2, "a file name consists of"},
                      Refused{"-o pipe:1.mp4", 2, "a file name consists of"},
                      Refused{"-o %03d.mp4", 2, "a file name consists of"},
                      Refused{"-o %03d.png", 2, "a file name consists of"},
                      Refused{"-o folder", 1, "it is a folder; name a file in it"},
                      Refused{"-o x.mov", 2, "available: mp4, webm, avi, mkv, gif, png"},
                      Refused{"-o x", 2, "its extension is missing"},
                      Refused{"-o x.mp4 --size 641x360", 2, "must be even"},
                      Refused{"-o x.mp4 --fps 0", 2, "fps is 0"},
                      Refused{"-o missing/x.mp4", 1, "does not exist"},
                      Refused{"-o /proc/x.mp4", 1, "cannot write"},
                      Refused{"-o x.webm --encoder opencv --to 0.1", 1, "available: mp4, avi, mkv"},
                      Refused{"-o x.mp4 --poster p.jpg --to 0.1", 2, "available: png"}));

// Derived: where ffmpeg is not installed OpenCV takes over, and who insists is told what there is.
TEST(VideoFailure, SaysWhichEncodersThereAre) {
  const TemporaryFolder folder;
  const std::string without_ffmpeg =
      "program=$(command -v ghtrack); PATH=/nowhere; \"$program\" video '" +
      scene_file("balloons.yaml").string() + "' --to 0.1 ";
  const Outcome insisting = shell(without_ffmpeg + "--encoder ffmpeg -o x.mp4", folder.path());
  EXPECT_EQ(insisting.exit_code, 1);
  EXPECT_THAT(insisting.err, HasSubstr("the encoder ffmpeg is not installed; available: opencv"));
  EXPECT_THAT(names_in(folder.path()), IsEmpty());
  EXPECT_EQ(shell(without_ffmpeg + "-o x.mp4", folder.path()).exit_code, 0);
}

// Derived: on a full disk the reason is named and nothing is left, whoever encodes.
TEST(VideoFailure, LeavesNothingOnAFullDisk) {
  const TemporaryFolder folder;
  if (::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=80k") != 0)
    GTEST_SKIP() << "mounting a small disk needs privileges";
  for (const std::string options : {"-o x.mp4", "-o x.mp4 --encoder opencv", "-o x.avi",
                                    "-o x.webm", "-o x.gif", "-o pictures/"}) {
    const Outcome outcome = shell(kVideo + options + " --to 2", folder.path());
    EXPECT_EQ(outcome.exit_code, 1) << options;
    EXPECT_THAT(outcome.err, HasSubstr("pace")) << options;  // "No space left", "no space left"
    // A hint at the help may follow.
    EXPECT_EQ(line_count(outcome.err.substr(0, outcome.err.find("Try '"))), 1) << outcome.err;
    EXPECT_THAT(names_in(folder.path()), IsEmpty()) << options;
  }
  ::umount(folder.path().c_str());
}

// Derived: SIGTERM ends it with 128 + 15; what was done so far can be played under its partial
// name.
TEST(VideoFailure, KeepsWhatWasDoneWhenItIsAskedToStop) {
  const TemporaryFolder folder;
  const Outcome outcome =
      shell(kVideo +
                "-o x.mp4 --slow 100 & job=$!; "
                "while [ ! -s .ghtrack-*/x.partial.mp4 ]; do sleep 0.05; done; sleep 0.5; "
                "kill -TERM $job; wait $job",
            folder.path());
  EXPECT_EQ(outcome.exit_code, 128 + 15) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("x.partial.mp4"));
  const Outcome probe =
      shell("ffprobe -v error -show_entries format=duration x.partial.mp4", folder.path());
  EXPECT_EQ(probe.exit_code, 0) << probe.err;
}

// Derived: kill -9 leaves nothing under the final name.
TEST(VideoFailure, LeavesNoFinalNameWhenItIsKilled) {
  const TemporaryFolder folder;
  const Outcome outcome = shell(kVideo +
                                    "-o x.mp4 --slow 100 & job=$!; "
                                    "while [ ! -s .ghtrack-*/x.partial.mp4 ]; do sleep 0.05; done; "
                                    "kill -KILL $job; wait $job",
                                folder.path());
  EXPECT_EQ(outcome.exit_code, 128 + 9);
  EXPECT_THAT(names_in(folder.path()), Not(::testing::Contains("x.mp4")));
}

}  // namespace
}  // namespace ghtrack::testing

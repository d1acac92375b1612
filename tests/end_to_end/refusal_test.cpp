// What a user can get wrong, and what the program says then.

#include <gmock/gmock.h>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

using ::testing::Each;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string kScene = scene_file("three_regimes.yaml").string();

struct Wrong {
  std::string command;
  int exit_code;
  std::string says;
};

class Refusal : public ::testing::TestWithParam<Wrong> {};

// Derived: exit codes and messages as documented: 2 for input, 1 for the environment.
TEST_P(Refusal, NamesWhatIsWrongAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  const Outcome outcome = shell(GetParam().command, folder.path());
  EXPECT_EQ(outcome.exit_code, GetParam().exit_code) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().says));
  EXPECT_THAT(outcome.err, Not(HasSubstr("terminate called")));
}

INSTANTIATE_TEST_SUITE_P(
    OfOptions, Refusal,
    ::testing::Values(
        Wrong{"ghtrack rum x", 2, "did you mean 'run'?"},
        Wrong{"ghtrack run " + kScene + " --sed 3", 2, "did you mean '--seed'?"},
        Wrong{"ghtrack run " + kScene + " --seed many", 2, "--seed"},
        Wrong{"ghtrack run", 2, "SCENE is required"},
        Wrong{"ghtrack run " + kScene + " --duration -1", 2, "duration"},
        Wrong{"ghtrack run " + kScene + " --set targets[99].name=x", 2, "targets[99]"},
        Wrong{"ghtrack run missing.yaml", 2, "missing.yaml"},
        Wrong{"ghtrack check " + kScene + " missing.yaml", 2, "missing.yaml"},
        Wrong{"ghtrack video " + kScene + " -o 'a:b.mp4'", 2, "a:b.mp4"},
        Wrong{"ghtrack video " + kScene + " -o tcp://127.0.0.1/x.mp4", 2, "file name"},
        Wrong{"ghtrack video " + kScene + " -o x.mp4 --size 321x241", 2, "even"},
        Wrong{"ghtrack video " + kScene + " -o x.exe", 2, "mp4"}));

INSTANTIATE_TEST_SUITE_P(
    OfTheEnvironment, Refusal,
    ::testing::Values(
        Wrong{"touch file && ghtrack run " + kScene + " --no-video -o file/below", 1, "file/below"},
        Wrong{"ghtrack run " + kScene + " --no-video -o /proc/nowhere", 1, "/proc/nowhere"},
        Wrong{"ghtrack schema > /dev/full", 1, "standard output"},
        Wrong{"ghtrack run " + kScene + " --duration 1 --no-video -o results > /dev/full", 1,
              "standard output"},
        Wrong{"ulimit -f 8; ghtrack run " + kScene + " --duration 5 --no-video -o results", 1,
              "File too large"}));

// Derived: a signal ends the run with 128 + N and no file under its final name.
TEST(Refusal, ASignalEndsARunWithoutAFileUnderItsFinalName) {
  const TemporaryFolder folder;
  const Outcome outcome = shell("ghtrack run " + kScene +
                                    " --duration 3000 --no-video -o results & job=$!; sleep 1; "
                                    "kill -TERM $job; wait $job",
                                folder.path());
  EXPECT_EQ(outcome.exit_code, 128 + 15) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  EXPECT_THAT(names_in(folder.path() / "results"), Each(EndsWith(".partial")));
}

// Derived: `--help` and `--version` succeed and show examples.
TEST(Help, SucceedsAndShowsExamples) {
  const TemporaryFolder folder;
  EXPECT_THAT(shell("ghtrack --version", folder.path()).out, HasSubstr("ghtrack "));
  for (const char* command : {"", "run", "video", "compare", "tune", "check", "schema", "filter",
                              "gains", "track", "score"}) {
    const Outcome outcome = shell(std::string("ghtrack ") + command + " --help", folder.path());
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("Examples:")) << command;
  }
}

// Derived: linking OpenCV's video libraries costs every start 164 ms, so the program does not.
TEST(Start, LoadsNoOpenCvUnlessAPictureIsAskedFor) {
  const TemporaryFolder folder;
  EXPECT_THAT(shell("ldd \"$(command -v ghtrack)\"", folder.path()).out, Not(HasSubstr("opencv")));
}

}  // namespace
}  // namespace ghtrack::testing

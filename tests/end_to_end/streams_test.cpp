// Every way to name what is read and written, and streams that are closed or full.

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// Detections of one body on a wavy line.
std::string some_detections() {
  std::string text = "t,x,y\n";
  for (int i = 0; i < 60; ++i) {
    const double wave = std::sin(2.0 * std::numbers::pi * i / 40.0);
    text +=
        std::to_string(0.1 * i) + "," + std::to_string(0.5 * i) + "," + std::to_string(wave) + "\n";
  }
  return text;
}

struct Way {
  std::string command;  // writes into the file `out`, or `target` through a link
  std::string out = "out";
};

class Output : public ::testing::TestWithParam<Way> {};

// Property: whatever the output is called, the same bytes arrive there, exit code 0, and neither a
// link nor a device is put out of its place.
TEST_P(Output, ArrivesUnderEveryName) {
  const TemporaryFolder folder;
  write(folder.path() / "d.csv", some_detections());
  ASSERT_EQ(shell("ghtrack -q track d.csv -o expected", folder.path()).exit_code, 0);
  const Outcome outcome = shell(GetParam().command, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(contents(folder.path() / GetParam().out), contents(folder.path() / "expected"));
  EXPECT_TRUE(fs::is_symlink("/dev/stdout"));
  for (const std::string& name : names_in(folder.path())) {
    EXPECT_THAT(name, Not(HasSubstr("partial")));
    EXPECT_EQ(fs::is_symlink(folder.path() / name), name.starts_with("link")) << name;
    EXPECT_EQ(fs::is_fifo(fs::symlink_status(folder.path() / name)), name == "pipe") << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Track, Output,
    ::testing::Values(
        Way{"ghtrack -q track d.csv > out"}, Way{"ghtrack -q track d.csv >> out"},
        Way{"ghtrack -q track d.csv | cat > out"}, Way{"ghtrack -q track d.csv -o - > out"},
        Way{"ghtrack -q track d.csv -o /dev/stdout > out"},
        Way{"ghtrack -q track d.csv -o /dev/stdout | cat > out"},
        Way{"ghtrack -q track d.csv -o /dev/fd/1 > out"},
        Way{"ghtrack -q track d.csv -o /proc/self/fd/1 > out"},
        Way{"ghtrack -q track d.csv -o /dev/fd/7 7> out"},
        Way{"ghtrack -q track d.csv -o /dev/stderr 2> out"},
        Way{"ln -s /dev/stdout link && ghtrack -q track d.csv -o link > out"},
        Way{"touch out && ln -s out link && ghtrack -q track d.csv -o link"},
        Way{"ln -s out link && ln -s link link2 && ghtrack -q track d.csv -o link2"},
        Way{"mkdir deep && touch deep/out && ln -s deep/out link && ghtrack -q track d.csv -o link",
            "deep/out"},
        Way{"mkfifo pipe && { cat pipe > out & ghtrack -q track d.csv -o pipe && wait; }"},
        Way{"touch out && chmod 600 out && ghtrack -q track d.csv -o out && "
            "test $(stat -c %a out) = 600"},
        // and as input
        Way{"ghtrack -q track - < d.csv > out"}, Way{"cat d.csv | ghtrack -q track - -o out"},
        Way{"cat d.csv | ghtrack -q track /dev/stdin -o out"},
        Way{"ghtrack -q track /dev/fd/8 8< d.csv > out"},
        Way{"bash -c 'ghtrack -q track <(cat d.csv) > >(cat > out)'; sleep 0.3"}));

// Property: what other commands read and write has the same names.
TEST(Streams, AreTakenByEveryCommand) {
  const TemporaryFolder folder;
  fs::create_symlink(fs::path(GHTRACK_SOURCE_DIR) / "scenes", folder.path() / "scenes");
  for (const std::string command :
       {"ghtrack check - < scenes/throwing.yaml", "cat scenes/throwing.yaml | ghtrack check -",
        "ghtrack run - -q --duration 1 --no-video -o a < scenes/throwing.yaml",
        "ghtrack score --truth - --tracks a/tracks.csv < a/truth.csv",
        "ghtrack score --truth a/truth.csv --tracks - --per-step - < a/tracks.csv",
        "printf '1\\n2\\n' | ghtrack filter --g 0.5 --h 0.1 --x0 0",
        "printf 'noise: 1\\n' | ghtrack -q track a/detections.csv --config - -o b.csv"}) {
    const Outcome outcome = shell(command, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << command << "\n" << outcome.err;
  }
  for (const std::string command :
       {"run scenes/throwing.yaml --duration 1 --no-video -o -",
        "compare scenes/throwing.yaml --runs 1 -o -", "tune scenes/throwing.yaml --runs 1 -o -",
        "video scenes/throwing.yaml --to 0.1 -o -"}) {
    const Outcome outcome = shell("ghtrack " + command, folder.path());
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_FALSE(fs::exists(folder.path() / "-")) << command;
  }
}

// Property: nobody has to listen to messages: a closed or full standard error changes nothing but
// that they are lost, and they never end up in a file of results.
TEST(Streams, MayBeClosedOrFullWhereMessagesGo) {
  const TemporaryFolder folder;
  const std::string scene = "'" + scene_file("throwing.yaml").string() + "'";
  write(folder.path() / "d.csv", some_detections());
  for (const std::string where : {"2>&-", "2>/dev/full", "<&- 2>&-"}) {
    for (const auto& [command, exit_code] :
         {std::pair<std::string, int>{"run missing.yaml", 2},
          {"nonsense", 2},
          {"run " + scene + " --duration 1 --no-video -o results", 0},
          {"track d.csv --timings -o tracks.csv", 0},
          {"gains manual --g 0.5 --h 3.9", 0},
          {"run " + scene + " --duration 1 --no-video -o /proc/nowhere", 1}}) {
      const Outcome outcome = shell("ghtrack " + command + " " + where, folder.path());
      EXPECT_EQ(outcome.exit_code, exit_code) << command << " " << where;
    }
  }
  const Outcome again =
      shell("ghtrack run " + scene + " --duration 1 --no-video -o again", folder.path());
  for (const std::string& name : names_in(folder.path() / "again")) {
    EXPECT_EQ(contents(folder.path() / "again" / name), contents(folder.path() / "results" / name));
  }
}

// Property: results that do not arrive are a failure, whichever command makes them.
TEST(Streams, FailWhereResultsAreLost) {
  const TemporaryFolder folder;
  write(folder.path() / "d.csv", some_detections());
  for (const std::string where : {">&-", "> /dev/full"}) {
    for (const std::string command :
         {"track d.csv", "gains manual --g 0.5 --h 0.1", "schema", "--help", "--version",
          "filter --g 0.5 --h 0.1 --x0 0 < /dev/stdin", "track d.csv -o /dev/full"}) {
      const Outcome outcome =
          shell("printf '1\\n2\\n' | ghtrack " + command + " " + where, folder.path());
      EXPECT_EQ(outcome.exit_code, 1) << command << " " << where << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("error")) << command;
    }
  }
}

}  // namespace
}  // namespace ghtrack::testing

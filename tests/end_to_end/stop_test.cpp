// What comes in between: signals, other processes, kill -9, links and foreign files in the way.

#include <gmock/gmock.h>

#include <fstream>

#include "tests/effort.hpp"
#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

const std::string kQuotedScene = "'" + scene_file("three_regimes.yaml").string() + "'";

/// So many detections at one instant, in one square metre, again and again.
void write_crowd(const fs::path& file, int points, int scans) {
  std::ofstream text(file);
  text << "t,x,y\n";
  for (int scan = 0; scan < scans; ++scan) {
    for (int i = 0; i < points; ++i) {
      text << scan << ',' << (i % 97) / 97.0 << ',' << (i % 89) / 89.0 << '\n';
    }
  }
}

struct Lasting {
  std::string name, prepare, command;
};

class Stop : public ::testing::TestWithParam<Lasting> {};

// Property: whatever a command is busy with or waits for, a signal ends it with 128 + N, soon
// (`timeout` would say 124 or 137) and without scratch files.
TEST_P(Stop, ComesWhateverTheCommandIsBusyWith) {
  for (const auto& [signal, exit_code] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    const TemporaryFolder folder;
    write_crowd(folder.path() / "crowd.csv", 3000, 300);
    const Outcome outcome =
        shell(GetParam().prepare + GetParam().command + " & pid=$!; sleep 1; kill -" + signal +
                  " $pid; timeout 20 tail --pid=$pid -f /dev/null && wait $pid",
              folder.path());
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr(".ghtrack-"))) << entry.path();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, Stop,
    ::testing::Values(
        Lasting{"FilterOnAPipe", "mkfifo pipe; exec 8<>pipe; ",
                "ghtrack filter - --g 0.5 --h 0.2 --x0 0 <pipe"},
        Lasting{"FilterOnAFifo", "mkfifo pipe; ", "ghtrack filter pipe --g 0.5 --h 0.2 --x0 0"},
        Lasting{"TrackFromAPipe", "mkfifo pipe; exec 8<>pipe; ", "ghtrack track - -o t.csv <pipe"},
        Lasting{"TrackIntoAFifo", "mkfifo pipe; ", "ghtrack track crowd.csv -o pipe"},
        Lasting{"TrackACrowd", "", "ghtrack track crowd.csv -o t.csv"},
        Lasting{"ScoreACrowd",
                "awk -F, -v OFS=, '{ $1 = $1 OFS (NR == 1 ? \"truth_id\" : NR % 3000) } 1' "
                "crowd.csv >a; "
                "sed '1s/truth_id/track_id/' a >b; ",
                "ghtrack score --truth a --tracks b"},
        Lasting{"RunAnHour", "",
                "ghtrack run " + kQuotedScene + " --duration 20000 --no-video -o r"},
        Lasting{"Video", "", "ghtrack video " + kQuotedScene + " -o v.mp4 --slow 50"},
        Lasting{"Compare", "", "ghtrack compare " + kQuotedScene + " --runs 5000 -o c"},
        Lasting{"Tune", "", "ghtrack tune " + kQuotedScene + " --runs 500"}),
    [](const auto& one) { return one.param.name; });

// Derived: a pipe among the parts of a campaign is no part, and nobody waits for it.
TEST(Merge, WaitsForNoPipe) {
  const TemporaryFolder folder;
  const Outcome outcome = shell(
      "mkdir parts && mkfifo parts/shard-0-of-1.runs && timeout 20 ghtrack compare --merge parts",
      folder.path());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
}

// Property: while a run writes into a folder no other one does; the folder then holds one result.
TEST(TwoProcesses, NeverMixTheirFiles) {
  const TemporaryFolder folder;
  const std::string run = "ghtrack run " + kQuotedScene + " -q --no-video --duration 6 ";
  ASSERT_EQ(shell(run + "--seed 1 -o one && " + run + "--seed 2 -o two", folder.path()).exit_code,
            0);
  for (int i = 0; i < 5; ++i) {
    const Outcome both =
        shell(run + "--seed 1 -o race >table & a=$!; sleep 0.0" + std::to_string(2 * i + 1) + "; " +
                  run + "--seed 2 -o race >table2; echo $?; wait $a; echo $?",
              folder.path());
    if (both.out.find("1\n") != std::string::npos) {
      EXPECT_THAT(both.err, HasSubstr("another process is writing"));
    }
    EXPECT_THAT(both.out, HasSubstr("0\n")) << both.err;
    for (const std::string name : {"truth.csv", "detections.csv", "origins.csv", "tracks.csv",
                                   "metrics.json", "scene.yaml"}) {
      const std::string seed = contents(folder.path() / "race" / "scene.yaml");
      const std::string winner =
          seed == contents(folder.path() / "one" / "scene.yaml") ? "one" : "two";
      EXPECT_EQ(contents(folder.path() / "race" / name), contents(folder.path() / winner / name));
    }
    EXPECT_THAT(names_in(folder.path() / "race"), Each(Not(HasSubstr("partial"))));
  }
}

// Property: kill -9 at any time leaves no cut file under a final name, and nothing that is in the
// way of the next run, which also takes away what the killed one left.
TEST(Kill, LeavesWholeFilesAndNothingInTheWay) {
  const TemporaryFolder folder;
  const std::string run = "ghtrack run " + kQuotedScene + " -q --no-video --duration 6 ";
  ASSERT_EQ(shell(run + "--seed 1 -o one", folder.path()).exit_code, 0);
  fs::create_directory(folder.path() / "r");  // a run may be killed before it makes it
  for (int i = 0; i < 8; ++i) {
    shell(run + "--seed 1 -o r & sleep 0." + std::to_string(i + 1) + "; kill -9 $!; wait",
          folder.path());
    for (const std::string& name : names_in(folder.path() / "r")) {
      if (name.starts_with(".ghtrack-")) continue;
      EXPECT_EQ(contents(folder.path() / "r" / name), contents(folder.path() / "one" / name));
    }
  }
  const Outcome last = shell(run + "--seed 1 -o r", folder.path());
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(names_in(folder.path() / "r"), names_in(folder.path() / "one"));
}

// Property: what stands where temporary files of earlier versions stood is neither written through
// nor removed, and neither are foreign files.
TEST(Foreign, FilesStayWhatTheyAre) {
  const TemporaryFolder folder;
  const fs::path& at = folder.path();
  write(at / "victim", "mine\n");
  fs::create_directories(at / "r");
  for (const std::string name : {"truth.csv", "tracks.csv", "metrics.json", "scene.yaml"}) {
    fs::create_symlink(at / "victim", at / "r" / (name + ".partial"));
  }
  fs::create_symlink(at / "victim", at / "t.csv.partial");
  fs::create_symlink(at / "victim", at / "v.partial.avi");
  fs::create_directories(at / "pics.partial");
  write(at / "pics.partial" / "mine.txt", "mine\n");
  fs::create_directories(at / "full");
  write(at / "full" / "frame_000000.png", "mine\n");
  fs::create_directories(at / "c");
  fs::create_symlink(at / "victim", at / "c" / "shard-0-of-1.runs.partial");
  const std::string video = "ghtrack video " + kQuotedScene + " -q --to 0.1 --size 320x180 ";
  EXPECT_EQ(shell("ghtrack run " + kQuotedScene + " -q --no-video --duration 1 -o r", at).exit_code,
            0);
  EXPECT_EQ(shell("ghtrack -q track r/detections.csv -o t.csv", at).exit_code, 0);
  EXPECT_EQ(shell(video + "-o v.avi", at).exit_code, 0);
  EXPECT_EQ(shell(video + "-o pics/ && " + video + "-o pics/", at).exit_code, 0);
  EXPECT_EQ(shell(video + "-o full/", at).exit_code, 2);
  EXPECT_EQ(
      shell("ghtrack compare " + kQuotedScene + " -q --runs 1 --duration 1 -o c", at).exit_code, 1);
  EXPECT_EQ(contents(at / "victim"), "mine\n");
  EXPECT_EQ(contents(at / "pics.partial" / "mine.txt"), "mine\n");
  EXPECT_EQ(contents(at / "full" / "frame_000000.png"), "mine\n");
  EXPECT_TRUE(fs::is_symlink(at / "t.csv.partial"));
  EXPECT_THAT(names_in(at / "pics"), Contains("frame_000000.png"));
}

// Property: a result's files appear together: where one cannot be put into its place, all older
// ones stand as before.
TEST(Together, AllFilesOrNone) {
  const TemporaryFolder folder;
  const std::string run = "ghtrack run " + kQuotedScene + " -q --no-video --duration 1 -o r ";
  ASSERT_EQ(shell(run + "--seed 1", folder.path()).exit_code, 0);
  const std::string truth = contents(folder.path() / "r" / "truth.csv");
  ASSERT_EQ(shell("rm r/tracks.csv && mkdir r/tracks.csv", folder.path()).exit_code, 0);
  const Outcome outcome = shell(run + "--seed 2", folder.path());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("tracks.csv"));
  EXPECT_EQ(contents(folder.path() / "r" / "truth.csv"), truth);
  EXPECT_THAT(contents(folder.path() / "r" / "scene.yaml"), HasSubstr("seed: 1\n"));
  EXPECT_THAT(names_in(folder.path() / "r"), Each(Not(HasSubstr("partial"))));
}

// Derived: without threads, or memory for them, one thread does the work, or a sentence says why
// not; the results are the same.
TEST(Threads, AreNotNeeded) {
  if (kSanitized) GTEST_SKIP() << "the sanitizers need more addresses than these limits leave";
  const TemporaryFolder folder;
  const std::string compare = "ghtrack compare " + kQuotedScene + " -q --runs 4 --duration 2 ";
  ASSERT_EQ(shell(compare + "--jobs 1 -o one", folder.path()).exit_code, 0);
  for (const std::string limit : {"ulimit -v 200000", "ulimit -v 120000", "ulimit -v 30000"}) {
    for (const std::string& command :
         {compare + "--jobs 4 -o four",
          "ghtrack tune " + kQuotedScene + " -q --runs 2 --duration 2",
          "ghtrack video " + kQuotedScene + " -q --to 0.1 --size 320x180 -o v.mp4"}) {
      const Outcome outcome = shell("(" + limit + "; " + command + ")", folder.path());
      if (outcome.exit_code == 127) continue;  // too little to load the program
      EXPECT_THAT(outcome.exit_code, ::testing::AnyOf(0, 1)) << limit << " " << command;
      EXPECT_THAT(outcome.err, Not(HasSubstr("terminate"))) << limit << " " << command;
      EXPECT_THAT(outcome.err, Not(HasSubstr("standard output"))) << limit << " " << command;
    }
  }
}

}  // namespace
}  // namespace ghtrack::testing

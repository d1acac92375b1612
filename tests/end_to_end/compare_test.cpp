// The promises of `ghtrack compare` and `ghtrack tune`, checked by running the program: the same
// bytes however the runs are dealt out and whatever stops them.

#include <gmock/gmock.h>
#include <sys/mount.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kFlyBall = R"(
name: fly ball
seed: 5
duration: 3
targets:
  - {name: fly ball, ball: {type: baseball, position: [0, 1.8], velocity: [12, 13]}}
sensors:
  - {name: camera, rate: 20, noise: 0.3}
compare:
  runs: 6
  launch: {velocity: 1}
  sweep: {"sensors[0].noise": [0.3, 1]}
  filters:
    sluggish: {gh: {g: 0.1, h: 0.01}}
    nimble: {gh: {g: 0.5, h: 0.2}}
)";

/// A comparison that is long enough to be stopped on its way.
const std::string kLong = "scene.yaml --runs 400 --set sensors[0].rate=100 --jobs 1 ";

/// Whether a program is installed.
bool has(const std::string& program) {
  return shell("command -v " + program, fs::temp_directory_path()).exit_code == 0;
}

class Compare : public ::testing::Test {
 protected:
  Compare() { write(folder() / "scene.yaml", kFlyBall); }

  const fs::path& folder() const { return folder_.path(); }
  Outcome run(const std::string& command) const { return shell(command, folder()); }
  Outcome compare(const std::string& arguments) const {
    return run("ghtrack compare " + arguments);
  }

  /// Runs a comparison in one piece, for others to be measured by.
  void compare_unbroken(const std::string& arguments) const {
    const Outcome outcome = compare(arguments + " -o unbroken");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  /// How many runs a folder of parts lacks, as merging says.
  int missing_runs(const std::string& parts) const {
    const Outcome outcome = compare("--merge " + parts);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    const std::string before = "compare: ";
    return std::stoi(outcome.err.substr(outcome.err.find(before) + before.size()));
  }

  void expect_as_unbroken(const std::string& results) const {
    for (const char* name : {"comparison.csv", "comparison.json", "runs.csv", "report.html"}) {
      EXPECT_TRUE(contents(folder() / "unbroken" / name) == contents(folder() / results / name))
          << results << "/" << name << " differs";
    }
  }

  /// Starts a command, waits until a part file grows by runs, sends a signal to a process, and
  /// waits for the command to end.
  Outcome stopped(const std::string& command, const std::string& part, const std::string& signal,
                  const std::string& process = "$job") const {
    return run(command + " & job=$!; begun=0\n" +
               "while kill -0 $job; do\n"
               "  size=$(stat -c %s " +
               part +
               " 2>/dev/null || echo 0)\n"
               "  [ $begun -eq 0 ] || [ $size -eq $begun ] || break\n"
               "  begun=$size; sleep 0.01\n"
               "done\n"
               "kill -" +
               signal + " " + process + "; wait $job");
  }

 private:
  TemporaryFolder folder_;
};

/// Starts MPI ranks, which need not all have a processor; each leaves its number in `pid-RANK`.
/// Open MPI itself leaks.
std::string mpirun(int ranks, const std::string& arguments) {
  return "env ASAN_OPTIONS=detect_leaks=0 mpirun -n " + std::to_string(ranks) +
         " sh -c 'echo $$ > pid-$OMPI_COMM_WORLD_RANK; exec ghtrack compare " + arguments + "'";
}

// Property: the bytes do not depend on the number of threads.
TEST_F(Compare, GivesTheSameBytesForAnyNumberOfThreads) {
  compare_unbroken("scene.yaml --jobs 1");
  ASSERT_EQ(compare("scene.yaml --jobs 2 -o two").exit_code, 0);
  ASSERT_EQ(compare("scene.yaml -o all").exit_code, 0);
  expect_as_unbroken("two");
  expect_as_unbroken("all");
}

// Property: parts made in any order, and merged in any place, give the bytes of an unbroken run.
TEST_F(Compare, MergesPartsMadeInAnyOrder) {
  compare_unbroken("scene.yaml");
  for (const char* shard : {"2/3", "0/3", "1/3"}) {
    ASSERT_EQ(compare("scene.yaml -o parts --shard " + std::string(shard)).exit_code, 0);
  }
  EXPECT_THAT(names_in(folder() / "parts"),
              ElementsAre("shard-0-of-3.runs", "shard-1-of-3.runs", "shard-2-of-3.runs"));
  fs::remove(folder() / "scene.yaml");
  ASSERT_EQ(compare("--merge parts -o elsewhere").exit_code, 0);
  ASSERT_EQ(compare("--merge parts").exit_code, 0);
  expect_as_unbroken("elsewhere");
  expect_as_unbroken("parts");
}

// Property: more shares than runs leave some of them empty, and nothing out.
TEST_F(Compare, MergesThePartsThatGnuParallelMakes) {
  if (!has("parallel")) GTEST_SKIP() << "GNU parallel is not installed";
  compare_unbroken("scene.yaml");
  const Outcome parallel =
      run("parallel --will-cite -j 4 ghtrack compare scene.yaml --jobs 1 -o parts --resume "
          "--shard {}/16 ::: $(seq 0 15) && ghtrack compare --merge parts");
  ASSERT_EQ(parallel.exit_code, 0) << parallel.err;
  expect_as_unbroken("parts");
}

// Property: MPI ranks share the runs and put them together.
TEST_F(Compare, GivesTheSameBytesFromMpiRanks) {
  if (!has("mpirun")) GTEST_SKIP() << "Open MPI is not installed";
  compare_unbroken("scene.yaml");
  const Outcome ranks = run(mpirun(4, "scene.yaml -o ranks --jobs 1"));
  ASSERT_EQ(ranks.exit_code, 0) << ranks.err;
  expect_as_unbroken("ranks");
  EXPECT_THAT(names_in(folder() / "ranks"), Contains("shard-3-of-4.runs"));
}

// Property: a rank that fails ends the others, instead of leaving them to wait for it.
TEST_F(Compare, EndsWhenAnMpiRankFails) {
  if (!has("mpirun")) GTEST_SKIP() << "Open MPI is not installed";
  fs::create_directories(folder() / "ranks" / "shard-1-of-2.runs.partial");
  const Outcome ranks = run("timeout -s KILL 60 " + mpirun(2, "scene.yaml -o ranks"));
  EXPECT_EQ(ranks.exit_code, 1) << ranks.err;
  EXPECT_THAT(ranks.err, HasSubstr("shard-1-of-2.runs.partial: error: cannot write"));
  EXPECT_FALSE(fs::exists(folder() / "ranks" / "comparison.csv"));
  const Outcome part = run(mpirun(2, "scene.yaml -o ranks --shard 0/2"));
  EXPECT_EQ(part.exit_code, 2) << part.err;
  EXPECT_THAT(part.err, HasSubstr("MPI ranks share the runs"));
}

// Property: what kills a comparison costs the runs that it was in; the rest is kept.
TEST_F(Compare, GoesOnWhereItWasKilled) {
  compare_unbroken(kLong);
  const std::string part = "killed/shard-0-of-1.runs.partial";
  const std::string command = "ghtrack compare " + kLong + " -o killed";
  EXPECT_EQ(stopped(command, part, "KILL").exit_code, 128 + 9);
  EXPECT_THAT(names_in(folder() / "killed"), ElementsAre("shard-0-of-1.runs.partial"));
  const int missing_once = missing_runs("killed");
  EXPECT_LT(missing_once, 800);
  EXPECT_EQ(stopped(command + " --resume", part, "KILL").exit_code, 128 + 9);
  EXPECT_LT(missing_runs("killed"), missing_once);
  ASSERT_EQ(run(command + " --resume").exit_code, 0);
  expect_as_unbroken("killed");
}

// Property: a killed rank costs its runs in flight; any other number of ranks does the rest.
TEST_F(Compare, GoesOnWithOtherRanksWhereOneWasKilled) {
  if (!has("mpirun")) GTEST_SKIP() << "Open MPI is not installed";
  compare_unbroken(kLong);
  const std::string ranks = mpirun(3, kLong + " -o ranks");
  const Outcome killed = stopped(ranks, "ranks/shard-1-of-3.runs.partial", "KILL", "$(cat pid-1)");
  EXPECT_NE(killed.exit_code, 0);
  EXPECT_THAT(names_in(folder() / "ranks"),
              AllOf(Contains("shard-1-of-3.runs.partial"), Not(Contains("comparison.csv"))));
  const Outcome rest = run(mpirun(2, kLong + " -o ranks --resume"));
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  expect_as_unbroken("ranks");
}

// Property: an interrupted comparison leaves no result, and says how to go on.
TEST_F(Compare, StopsWhenItIsInterruptedAndSaysHowToGoOn) {
  for (const auto& [signal, exit_code] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    const Outcome outcome = stopped("ghtrack compare scene.yaml --runs 100000 -o stopped",
                                    "stopped/shard-0-of-1.runs.partial", signal);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("ghtrack: interrupted; stopped keeps the runs that are "
                                       "done; the same command with --resume does the rest"));
    EXPECT_THAT(names_in(folder() / "stopped"), ElementsAre("shard-0-of-1.runs.partial"));
  }
}

// Property: a part is left alone once it is complete, and a process that died within its first
// bytes leaves one that can be gone on with.
TEST_F(Compare, LeavesCompletePartsAlone) {
  compare_unbroken("scene.yaml");
  const fs::path parts = folder() / "parts";
  ASSERT_EQ(compare("scene.yaml -o parts --shard 0/2").exit_code, 0);
  const auto written = fs::last_write_time(parts / "shard-0-of-2.runs");
  write(parts / "shard-1-of-2.runs.partial", "");
  ASSERT_EQ(compare("scene.yaml -o parts --shard 0/2 --resume").exit_code, 0);
  ASSERT_EQ(compare("scene.yaml -o parts --shard 1/2 --resume").exit_code, 0);
  EXPECT_EQ(fs::last_write_time(parts / "shard-0-of-2.runs"), written);
  ASSERT_EQ(compare("--merge parts").exit_code, 0);
  expect_as_unbroken("parts");
}

// Property: any run can be had again alone, as it stands in the table.
TEST_F(Compare, ReplaysARunAsItStandsInTheTable) {
  compare_unbroken("scene.yaml");
  const Outcome replay = compare("scene.yaml --run 4");
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  std::istringstream table(contents(folder() / "unbroken/runs.csv"));
  std::string expected;  // the header, and the rows of run 4
  const std::regex of_run_4("[^,]*,[^,]*,4,.*");
  for (std::string line; std::getline(table, line);) {
    if (expected.empty() || std::regex_match(line, of_run_4)) expected += line + "\n";
  }
  EXPECT_EQ(std::count(expected.begin(), expected.end(), '\n'), 1 + 2 * 2 * 3);
  EXPECT_EQ(replay.out, expected);
}

// Derived: parts of another comparison, and missing ones, are the user's to sort out.
TEST_F(Compare, RefusesForeignAndMissingParts) {
  ASSERT_EQ(compare("scene.yaml -o parts --shard 1/3").exit_code, 0);
  Outcome outcome = compare("--merge parts");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("8 of 12 runs are missing in 'parts'"));

  outcome = compare("scene.yaml --seed 6 -o parts --resume");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("parts/shard-1-of-3.runs: error: is of another campaign"));

  write(folder() / "parts/notes.runs", "no runs at all");
  for (const char* command : {"--merge parts", "scene.yaml -o parts --resume"}) {
    outcome = compare(command);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("parts/notes.runs: error: is not a file of runs"));
  }
  EXPECT_FALSE(fs::exists(folder() / "parts/comparison.csv"));
}

/// What is wrong with a command line, and what the program says.
struct Wrong {
  std::string arguments;
  std::string says;
};

class CompareRefusal : public Compare, public ::testing::WithParamInterface<Wrong> {};

// Derived: exit code 2 and a sentence that says what is wanted.
TEST_P(CompareRefusal, SaysWhatIsWantedAndWritesNothing) {
  write(folder() / "empty.yaml", "filters: {}\n");
  write(folder() / "typo.yaml", "filters: {a: {gh: {g: 0.5, hh: 0.2}}}\n");
  const Outcome outcome = run("ghtrack " + GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().says));
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(names_in(folder()), ElementsAre("empty.yaml", "scene.yaml", "typo.yaml"));
}

INSTANTIATE_TEST_SUITE_P(
    OfOptions, CompareRefusal,
    ::testing::Values(
        Wrong{"compare", "needs a SCENE, or --merge"},
        Wrong{"compare scene.yaml --shard 8/8", "--shard is '8/8'; wanted is I/N with I from 0 to"},
        Wrong{"compare scene.yaml --shard 1", "--shard is '1'; wanted is I/N"},
        Wrong{"compare scene.yaml --shard -1/4", "--shard is '-1/4'; wanted is I/N"},
        Wrong{"compare scene.yaml --shard 0/0", "--shard is '0/0'; wanted is I/N"},
        Wrong{"compare scene.yaml --shard 0/4x", "--shard is '0/4x'; wanted is I/N"},
        Wrong{"compare scene.yaml --sweep noise", "--sweep 'noise': error: wanted is KEY=VALUE,"},
        Wrong{"compare scene.yaml --sweep =1,2", "--sweep '=1,2': error: wanted is KEY=VALUE,"},
        Wrong{"compare scene.yaml --sweep seed=1,,2", "--sweep 'seed=1,,2': error: wanted is"},
        Wrong{"compare scene.yaml --sweep sensors[0].nois=1", "did you mean 'noise'?"},
        Wrong{"compare scene.yaml --sweep sensors[0].noise=1,-1", "must be above 0"},
        Wrong{"compare scene.yaml --filters none.yaml", "none.yaml: error: cannot be read"},
        Wrong{"compare scene.yaml --filters empty.yaml", "empty.yaml: error: names no filters"},
        Wrong{"compare scene.yaml --filters typo.yaml", "filters.a.gh.hh"},
        Wrong{"compare scene.yaml --jobs 0", "--jobs is 0; allowed: 1 to 1024"},
        Wrong{"compare scene.yaml --jobs many", "--jobs is 'many', which is no whole number"},
        Wrong{"compare scene.yaml --runs 0", "--runs is 0; allowed: 1 to 1000000"},
        Wrong{"compare scene.yaml --runs 1.5", "--runs is '1.5', which is no whole number"},
        Wrong{"compare scene.yaml --run -1", "--run is -1; allowed: 0 to 999999"},
        Wrong{"compare scene.yaml --resum", "did you mean '--resume'?"},
        Wrong{"compare --merge nowhere", "no part files (shard-I-of-N.runs) in 'nowhere'"},
        Wrong{"compare " + scene_file("textbook/train.yaml").string(), "is a series"},
        Wrong{"tune " + scene_file("textbook/train.yaml").string(), "is a series"},
        Wrong{"tune scene.yaml --design benedict-bordnr", "did you mean 'benedict-bordner'?"},
        Wrong{"tune scene.yaml --filter kalman", "--filter is 'kalman'; allowed are gh and ghk"},
        Wrong{"tune scene.yaml --runs 0", "--runs is 0; allowed"}));

/// A disk of a few kilobytes in a folder, where that may be mounted.
class SmallDisk {
 public:
  SmallDisk(fs::path folder, const std::string& size, unsigned long flags)
      : folder_(std::move(folder)) {
    fs::create_directories(folder_);
    mounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", flags, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount(folder_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }

 private:
  fs::path folder_;
  bool mounted_ = false;
};

// Property: whichever file a full disk hits, those that have their final names are whole.
TEST_F(Compare, LeavesNoBrokenFileOnAFullDisk) {
  compare_unbroken("scene.yaml --jobs 1");
  for (const char* size : {"8k", "32k", "64k", "192k"}) {
    SCOPED_TRACE(size);
    const SmallDisk disk(folder() / "disk", size, 0);
    if (!disk.mounted()) GTEST_SKIP() << "mounting a small disk needs privileges";
    const Outcome outcome = compare("scene.yaml --jobs 1 -o disk");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("error: cannot write: No space left on device"));
    for (const std::string& name : names_in(folder() / "disk")) {
      if (name.ends_with(".partial")) continue;
      EXPECT_TRUE(contents(folder() / "disk" / name) == contents(folder() / "unbroken" / name))
          << name << " is broken";
    }
  }
}

// Derived: a folder that cannot be written is the environment's failure, named with its path.
TEST_F(Compare, NamesAFolderThatCannotBeWritten) {
  Outcome outcome = compare("scene.yaml -o scene.yaml/below");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("scene.yaml/below: error: the folder cannot be made"));
  const SmallDisk disk(folder() / "disk", "64k", MS_RDONLY);
  if (!disk.mounted()) GTEST_SKIP() << "mounting a small disk needs privileges";
  for (const char* arguments : {"-o disk", "-o disk --shard 0/2", "-o disk/below"}) {
    outcome = compare("scene.yaml " + std::string(arguments));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("disk/"), HasSubstr("Read-only file system")));
  }
}

// Property: tuning writes what it prints, the surface it searched, and gains to be pasted.
TEST_F(Compare, TunesGainsAndWritesThem) {
  const std::string tune = "ghtrack tune scene.yaml --runs 4 --filter gh ";
  const Outcome outcome = run(tune + "-o tuned");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(names_in(folder() / "tuned"),
              ElementsAre("gains.yaml", "report.html", "surface-ball.csv", "tuning.json"));
  EXPECT_THAT(outcome.out, EndsWith(contents(folder() / "tuned/gains.yaml")));
  EXPECT_TRUE(nlohmann::json::accept(contents(folder() / "tuned/tuning.json")));
  EXPECT_EQ(csv_rows(folder() / "tuned/surface-ball.csv").front(),
            (std::vector<std::string>{"g", "h", "expected_rmse"}));
  ASSERT_EQ(run("cat tuned/gains.yaml >> scene.yaml && ghtrack check scene.yaml").exit_code, 0);
  EXPECT_EQ(run(tune + "--jobs 1").exit_code, 0);
}

// Property: filters that are tuned first are tuned once and alike, whoever computes which runs, and
// an interrupted comparison goes on with those that it had found.
TEST_F(Compare, TunesAlikeHoweverTheRunsAreDealtOut) {
  std::string text = kFlyBall;
  text.replace(text.find("  filters:"), 10, "  tuned: [gh, kalman]\n  filters:");
  write(folder() / "tuned.yaml", text);
  compare_unbroken("tuned.yaml");
  EXPECT_THAT(contents(folder() / "unbroken/comparison.csv"),
              AllOf(HasSubstr(",tuned g-h,"), HasSubstr(",tuned Kalman,"), HasSubstr(",nimble,")));
  for (const char* shard : {"1/2", "0/2"}) {
    ASSERT_EQ(compare("tuned.yaml -o parts --shard " + std::string(shard)).exit_code, 0);
  }
  ASSERT_EQ(compare("--merge parts").exit_code, 0);
  expect_as_unbroken("parts");
  ASSERT_EQ(compare("tuned.yaml -o gone --jobs 1").exit_code, 0);
  for (const std::string& name : names_in(folder() / "gone")) {
    if (!name.starts_with("tuned-")) fs::remove(folder() / "gone" / name);
  }
  ASSERT_EQ(compare("tuned.yaml -o gone --resume").exit_code, 0);
  expect_as_unbroken("gone");
  if (!has("mpirun")) return;
  const Outcome ranks = run(mpirun(2, "tuned.yaml -o ranks --jobs 1"));
  ASSERT_EQ(ranks.exit_code, 0) << ranks.err;
  expect_as_unbroken("ranks");
}

// Property: the study tunes, compares, draws and writes its table; a second call has nothing to do
// and writes the same.
TEST_F(Compare, MakesTheStudy) {
  const fs::path root(GHTRACK_SOURCE_DIR);
  fs::create_directories(folder() / "tools");
  fs::create_directories(folder() / "scenes");
  fs::copy(root / "tools/study", folder() / "tools/study");
  fs::copy(root / "scenes/study", folder() / "scenes/study");
  const std::string study =
      "tools/study $(command -v ghtrack) --runs 5 --sweep sensors[0].rate=1 --sweep "
      "sensors[0].noise=3";
  Outcome outcome = run(study);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string written = contents(folder() / "scenes/study/README.md");
  for (const char* motion : {"train", "ball", "balloon", "aircraft"}) {
    EXPECT_THAT(written, HasSubstr("| " + std::string(motion) + " |"));
  }
  EXPECT_TRUE(fs::exists(folder() / ".media/study.svg"));
  outcome = run(study);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(contents(folder() / "scenes/study/README.md"), written);
}

// Property: tuning, which writes nothing before its end, can be interrupted.
TEST_F(Compare, StopsTuningWhenInterrupted) {
  const Outcome outcome = run(
      "timeout --preserve-status -s INT 3 ghtrack tune scene.yaml --runs 100000 --jobs 1 -o tuned");
  EXPECT_EQ(outcome.exit_code, 130);
  // On a busy machine it is ended before it can say that nothing was written.
  EXPECT_THAT(outcome.err, HasSubstr("ghtrack: interrupted"));
  EXPECT_THAT(names_in(folder()), ElementsAre("scene.yaml"));
}

}  // namespace
}  // namespace ghtrack::testing

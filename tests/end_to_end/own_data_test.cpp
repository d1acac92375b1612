// Other people's data from outside: the page "Your own data", and what its readers promise.

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// The lines of a page's ```sh blocks.
std::vector<std::string> commands_of(const fs::path& page) {
  std::vector<std::string> commands;
  std::ifstream text(page);
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = line == "```sh";
    } else if (inside) {
      commands.push_back(line);
    }
  }
  return commands;
}

// Property: the page tells the truth; each of its examples ends in a picture.
TEST(OwnData, EveryCommandOfThePageSucceeds) {
  const TemporaryFolder folder;
  fs::create_symlink(fs::path(GHTRACK_SOURCE_DIR) / "tools", folder.path() / "tools");
  const auto commands = commands_of(fs::path(GHTRACK_SOURCE_DIR) / "tools/data/README.md");
  ASSERT_GE(commands.size(), 7U);
  for (const std::string& command : commands) {
    const Outcome outcome = shell(command, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << command << "\n" << outcome.err;
  }
  EXPECT_THAT(contents(folder.path() / "walk.svg"), HasSubstr("<svg"));
  EXPECT_THAT(contents(folder.path() / "toss.pdf"), StartsWith("%PDF"));
  EXPECT_THAT(contents(folder.path() / "street.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(contents(folder.path() / "walk.gpx"), HasSubstr("<time>2024-06-11T09:30:"));
}

// Property: `score` says the same of the files of a run as the run itself, parameters included.
TEST(OwnData, ScoreAgreesWithTheRun) {
  const TemporaryFolder folder;
  ASSERT_EQ(shell("ghtrack run " + scene_file("three_regimes.yaml").string() +
                      " --duration 5 --no-video -q -o run",
                  folder.path())
                .exit_code,
            0);
  const Outcome outcome = shell("ghtrack score --truth run --tracks run --json -q", folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto scored = nlohmann::json::parse(outcome.out);
  const auto run = nlohmann::json::parse(contents(folder.path() / "run/metrics.json"));
  for (const char* key : {"gospa", "gospa_localisation", "gospa_missed", "gospa_false", "ospa",
                          "mota", "idf1", "hota", "id_switches", "switches"}) {
    EXPECT_NEAR(scored.at(key).get<double>(), run.at("total").at(key).get<double>(), 1e-9) << key;
  }
  for (const char* key : {"gospa_c", "gospa_p", "gospa_alpha", "match_distance"}) {
    EXPECT_EQ(scored.at("parameters").at(key), run.at("parameters").at(key)) << key;
  }
}

// Property: what is said aloud is silent with --quiet, and bad rows are refused or counted.
TEST(OwnData, TellsWhatItUnderstood) {
  const TemporaryFolder folder;
  write(folder.path() / "d.csv", "Time (ms);East (cm);North (cm)\n0;1,5;2\n100;oops;3\n200;2,5;3\n");
  const Outcome refused = shell("ghtrack track d.csv -o t.csv", folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("d.csv:3:5: error: 'oops' in column 'East (cm)'"));
  EXPECT_FALSE(fs::exists(folder.path() / "t.csv"));
  const Outcome skipped = shell("ghtrack track d.csv --skip-bad-rows -o t.csv", folder.path());
  EXPECT_EQ(skipped.exit_code, 0) << skipped.err;
  EXPECT_THAT(skipped.err, HasSubstr("semicolons, decimal comma"));
  EXPECT_THAT(skipped.err, HasSubstr("left out 1 bad rows"));
  const Outcome quiet = shell("ghtrack track d.csv --skip-bad-rows -q -o t.csv", folder.path());
  EXPECT_EQ(quiet.err, "");
}

// Derived: two sequences, of which one is scored under other rules than its own file asks for.
TEST(OwnData, ScoresSeveralSequences) {
  const TemporaryFolder folder;
  for (const char* name : {"A", "B"}) {
    fs::create_directories(folder.path() / "truth" / name / "gt");
    fs::create_directories(folder.path() / "results");
    std::string truth, tracks;
    for (int frame = 1; frame <= 10; ++frame) {
      const std::string row = std::to_string(frame) + ",1," + std::to_string(3 * frame) + ",0,40,90,";
      truth += row + "1,1,1\n";
      if (*name == 'A' || frame > 5) tracks += row + "1,-1,-1,-1\n";
    }
    write(folder.path() / "truth" / name / "gt" / "gt.txt", truth);
    write(folder.path() / "results" / (std::string(name) + ".txt"), tracks);
  }
  const Outcome outcome =
      shell("ghtrack score --truth truth --tracks results --json --matches m.csv", folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("under the rules of MOT17"));
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("sequences").at("A").at("mota"), 1.0);
  EXPECT_EQ(json.at("sequences").at("B").at("mota"), 0.5);
  EXPECT_EQ(json.at("mota"), 0.75);
  EXPECT_EQ(csv_rows(folder.path() / "m.csv").size(), 21U);
}

}  // namespace
}  // namespace ghtrack::testing

// The words of the command line: what is repeated, out of range, misspelt, and what help says.

#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> kCommands = {"run",   "video", "view",   "compare",
                                            "tune",  "check", "filter", "gains",
                                            "track", "score", "plot",   "schema"};

std::size_t characters(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class Usage : public ::testing::Test {
 protected:
  Usage() { fs::create_symlink(fs::path(GHTRACK_SOURCE_DIR) / "scenes", folder() / "scenes"); }
  Outcome ghtrack(const std::string& words) { return shell("ghtrack " + words, folder()); }
  const fs::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

// Property: no option takes an empty value, such as a shell makes of a variable with nothing in it.
TEST_F(Usage, NoValueIsEmpty) {
  const std::regex with_value(R"(^ +(?:-\w,)?(--[a-z0-9-]+) [A-Z].*)");
  int options = 0;
  for (const std::string& command : kCommands) {
    for (const std::string& line : lines_of(ghtrack(command + " --help").out)) {
      std::smatch option;
      if (!std::regex_match(line, option, with_value)) continue;
      ++options;
      const Outcome outcome = ghtrack(command + " " + option.str(1) + " ''");
      EXPECT_EQ(outcome.exit_code, 2) << command << line;
      EXPECT_THAT(outcome.err,
                  AnyOf(HasSubstr(" is empty\n"), HasSubstr(option.str(1) + " is ''")));
    }
  }
  EXPECT_GT(options, 80);
}

// Derived: KEY=VALUE options apply as often as they are given, in their order.
TEST_F(Usage, OptionsOfKeysRepeat) {
  const std::string run = "run scenes/throwing.yaml -q --no-video -o a ";
  ASSERT_EQ(ghtrack(run + "--set duration=1 --set sensors[0].noise=0.25 --set seed=5 "
                          "--set seed=6")
                .exit_code,
            0);
  const std::string scene = contents(folder() / "a" / "scene.yaml");
  EXPECT_THAT(scene, HasSubstr("duration: 1\n"));
  EXPECT_THAT(scene, HasSubstr("noise: 0.25"));
  EXPECT_THAT(scene, HasSubstr("seed: 6\n"));
  ASSERT_EQ(ghtrack("compare scenes/throwing.yaml -q --runs 1 --duration 1 -o c "
                    "--sweep sensors[0].noise=0.3,1 --sweep sensors[0].rate=10,20,30")
                .exit_code,
            0);
  const std::string table = contents(folder() / "c" / "comparison.csv");
  EXPECT_THAT(table, HasSubstr("sensors[0].noise=1, sensors[0].rate=30"));
  EXPECT_THAT(table, HasSubstr("sensors[0].noise=0.3, sensors[0].rate=10"));
  const Outcome layers = ghtrack(
      "video --show fans --show grid --hide legend,hud scenes/throwing.yaml --to 0.1 "
      "--size 320x180 -o p.png");
  EXPECT_EQ(layers.exit_code, 0) << layers.err;
}

// Property: no command line makes another number of what it says: every numeric option refuses
// what is no number, infinite, or out of its range, and names itself.
TEST_F(Usage, NumbersHaveRanges) {
  struct Option {
    std::string command, name;
    std::vector<std::string> also_wrong;
  };
  const std::vector<Option> options = {
      {"run scenes/throwing.yaml --no-video", "--seed", {"-1", "18446744073709551616", "1.5"}},
      {"run scenes/throwing.yaml --no-video", "--duration", {"0", "-1", "1e7"}},
      {"video scenes/throwing.yaml -o x.mp4", "--fps", {"0", "-1", "1000"}},
      {"video scenes/throwing.yaml -o x.mp4", "--slow", {"0", "-1"}},
      {"video scenes/throwing.yaml -o x.mp4", "--from", {"-1"}},
      {"video scenes/throwing.yaml -o x.mp4", "--to", {"-1"}},
      {"compare scenes/throwing.yaml", "--runs", {"0", "-1", "1.5", "1000001"}},
      {"compare scenes/throwing.yaml", "--jobs", {"0", "-1", "4294967297"}},
      {"compare scenes/throwing.yaml", "--run", {"-1", "1000000"}},
      {"tune scenes/throwing.yaml", "--runs", {"0", "-1"}},
      {"gains manual --h 0.1", "--g", {}},
      {"gains tracking-index", "--index", {"0", "-1", "1e308"}},
      {"gains manual --g 0.5 --h 0.1", "--dt", {"0", "-1"}},
      {"gains manual --g 0.5 --h 0.1", "--sigma", {"0", "-1"}},
      {"gains manual --g 0.5 --h 0.1", "--accel", {}},
      {"gains least-squares", "--n", {"0", "-1", "2.5", "4294967297"}},
      {"gains least-squares --n 3", "--order", {"-1", "3", "4294967297"}},
      {"score --truth a --tracks b", "--gospa-c", {"0", "-1"}},
      {"score --truth a --tracks b", "--gospa-p", {"0.5"}},
      {"score --truth a --tracks b", "--match-distance", {"0", "-1"}}};
  for (const Option& option : options) {
    std::vector<std::string> wrong = {"nan", "inf", "-inf", "1e999", "0x10", "1,5", "many", "''"};
    wrong.insert(wrong.end(), option.also_wrong.begin(), option.also_wrong.end());
    for (const std::string& value : wrong) {
      const Outcome outcome = ghtrack(option.command + " " + option.name + "=" + value);
      EXPECT_EQ(outcome.exit_code, 2) << option.command << " " << option.name << " " << value;
      EXPECT_THAT(outcome.err, HasSubstr(option.name)) << option.command << " " << value;
    }
  }
}

// Derived: a misspelt word is named with what was meant, not the words around it.
TEST_F(Usage, NamesWhatIsMisspelt) {
  for (const auto& [words, says] : std::vector<std::pair<std::string, std::string>>{
           {"video scenes/throwing.yaml --sice 640x360", "did you mean '--size'?"},
           {"run scenes/throwing.yaml --sed 3", "did you mean '--seed'?"},
           {"run scenes/throwing.yaml -seed 3", "did you mean '--seed'?"},
           {"gains tracking-index --indx 0.5", "did you mean '--index'?"},
           {"rnu scenes/throwing.yaml", "did you mean 'run'?"},
           {"run --nonsense=1", "unknown option '--nonsense'"},
           {"gains tracking-indx --index 1", "did you mean 'tracking-index'?"},
           {"video scenes/throwing.yaml --show fan", "did you mean 'fans'?"}}) {
    const Outcome outcome = ghtrack(words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_THAT(outcome.err, HasSubstr(says)) << words;
  }
}

// Property: what a file or an option is called cannot do anything to a terminal, nor fill it.
TEST_F(Usage, ShowsNamesHarmlessly) {
  const std::string huge(30'000, 'k');
  write(folder() / "scene.yaml",
        "name: \"\\e[31mred\\u202e\"\nduration: 1\n"
        "targets: [{name: \"a\\u202eb\\e[2J\", ball: {position: [0, 1]}}]\n"
        "sensors: [{name: \"\\e]0;title\\a\"}]\n");
  for (const std::string& words :
       {std::string("run scene.yaml --no-video -o $(printf 'r\\033[31m')"),
        std::string("check $(printf 'no\\033[2J\\342\\200\\256such.yaml')"),
        "check scenes/throwing.yaml --set " + huge + "=1", "check " + huge + ".yaml", "--" + huge,
        huge, "gains " + huge, "video scenes/throwing.yaml --show " + huge,
        "score --truth " + huge + " --tracks " + huge,
        std::string("track $(printf 'no\\033[2J.csv')")}) {
    const Outcome outcome = ghtrack(words);
    for (const std::string& text : {outcome.out, outcome.err}) {
      EXPECT_LE(text.size(), 5000U) << words.substr(0, 60);
      EXPECT_EQ(text.find_first_of("\x1b\a"), std::string::npos) << words.substr(0, 60);
      EXPECT_THAT(text, Not(HasSubstr("\xe2\x80\xae"))) << words.substr(0, 60);
    }
  }
}

// Derived: every way to ask for help gives it, within 80 columns where nothing says otherwise.
TEST_F(Usage, HelpComesHoweverItIsAskedFor) {
  EXPECT_EQ(ghtrack("").out, ghtrack("--help").out);
  EXPECT_EQ(ghtrack("help").out, ghtrack("--help").out);
  for (const std::string& command : kCommands) {
    const Outcome help = ghtrack(command + " --help");
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(ghtrack("help " + command).out, help.out);
    bool is_example = false;  // these stay on one line, to be copied
    for (const std::string& line : lines_of(help.out)) {
      is_example = is_example || line.starts_with("Examples:");
      EXPECT_LE(is_example ? 0 : characters(line), 80U) << line;
    }
  }
}

class HelpOf : public Usage, public ::testing::WithParamInterface<std::string> {};

// Property: every example of every help works as it stands.
TEST_P(HelpOf, ShowsExamplesThatWork) {
  fs::create_directories(folder() / "out");
  const std::string help = ghtrack(GetParam() + " --help").out;
  if (help.find("out/three_regimes/") != std::string::npos) {  // what the example of `run` writes
    ASSERT_EQ(ghtrack("run scenes/three_regimes.yaml --no-video").exit_code, 0);
  }
  bool is_example = false;
  std::size_t examples = 0;
  for (const std::string& line : lines_of(help)) {
    is_example = (is_example || line == "Examples:") && !line.starts_with("With ");
    if (!is_example || !line.starts_with("  ")) continue;
    const Outcome outcome = shell(affordable(line), folder());
    if (outcome.err.find("wasi-libc") != std::string::npos) {
      GTEST_SKIP() << "no compiler for WebAssembly";
    }
    EXPECT_EQ(outcome.exit_code, 0) << line << "\n" << outcome.err;
    ++examples;
  }
  EXPECT_GE(examples, 1U);
}

INSTANTIATE_TEST_SUITE_P(Commands, HelpOf, ::testing::ValuesIn(kCommands),
                         [](const auto& command) { return command.param; });

// Derived: tables fit the terminal that COLUMNS tells of, and 80 columns without one.
TEST_F(Usage, TablesFitTheTerminal) {
  for (const std::string words : {"run scenes/three_regimes.yaml -q --duration 3 --no-video -o a",
                                  "compare scenes/three_regimes.yaml -q --runs 2 --duration 3 -o b",
                                  "tune scenes/throwing.yaml -q --runs 2 --duration 3"}) {
    for (const auto& [columns, width] : std::vector<std::pair<std::string, std::size_t>>{
             {"", 80}, {"COLUMNS=60 ", 60}, {"COLUMNS=200 ", 200}}) {
      const Outcome outcome = shell(columns + "ghtrack " + words, folder());
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      const auto lines = lines_of(outcome.out);
      for (const std::string& line : lines) {
        const bool is_row = line.find("  ", line.find_first_not_of(' ')) !=
                            std::string::npos;  // sentences may be longer
        EXPECT_LE(is_row ? characters(line) : 0, width) << columns << line;
      }
    }
  }
}

}  // namespace
}  // namespace ghtrack::testing

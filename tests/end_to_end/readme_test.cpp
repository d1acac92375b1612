// Every command that the README shows is run as it stands.

#include <gmock/gmock.h>

#include <fstream>
#include <vector>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;

/// The lines of each of the README's ```sh blocks that start the program, continued lines joined.
/// The two set-up commands are left to continuous integration, which calls them itself.
std::vector<std::vector<std::string>> shown_commands() {
  std::vector<std::vector<std::string>> blocks;
  std::ifstream text(fs::path(GHTRACK_SOURCE_DIR) / "README.md");
  bool inside = false;
  std::string command;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = line == "```sh";
      if (inside) blocks.emplace_back();
      continue;
    }
    if (!inside) continue;
    command += line;
    if (!command.empty() && command.back() == '\\') {
      command.back() = ' ';
      continue;
    }
    if (command.find("ghtrack ") != std::string::npos &&
        command.find("cmake") == std::string::npos) {
      blocks.back().push_back(command);
    }
    command.clear();
  }
  std::erase_if(blocks, [](const auto& block) { return block.empty(); });
  return blocks;
}

class Readme : public ::testing::TestWithParam<std::vector<std::string>> {};

void expect_success(const std::string& command, const fs::path& folder) {
  const bool starts_mpi = command.starts_with("mpirun ");  // Open MPI itself leaks
  const Outcome outcome =
      shell((starts_mpi ? "ASAN_OPTIONS=detect_leaks=0 " : "") + command, folder);
  const bool needs_wasm = outcome.err.find("compiler for WebAssembly") != std::string::npos;
  EXPECT_EQ(outcome.exit_code, needs_wasm ? 1 : 0) << command << "\n" << outcome.err;
}

// Property: the README tells the truth. What its first command writes, later blocks read.
TEST_P(Readme, EveryCommandItShowsSucceeds) {
  const TemporaryFolder folder;
  fs::create_symlink(fs::path(GHTRACK_SOURCE_DIR) / "scenes", folder.path() / "scenes");
  const std::string first = shown_commands().front().front();
  if (GetParam().front() != first) expect_success(first, folder.path());
  for (const std::string& command : GetParam()) {
    expect_success(affordable(command), folder.path());
  }
}

INSTANTIATE_TEST_SUITE_P(Block, Readme, ::testing::ValuesIn(shown_commands()),
                         [](const auto& block) { return std::to_string(block.index + 1); });

}  // namespace
}  // namespace ghtrack::testing

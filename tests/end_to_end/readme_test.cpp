// Every command that the README shows is run as it stands.

#include <gmock/gmock.h>

#include <fstream>
#include <vector>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;

/// The lines of the README's ```sh blocks that start the program, continued lines joined. The two
/// set-up commands are left to continuous integration, which calls them itself.
std::vector<std::string> shown_commands(const fs::path& readme) {
  std::vector<std::string> commands;
  std::ifstream text(readme);
  bool inside = false;
  std::string command;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = line == "```sh";
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
      commands.push_back(command);
    }
    command.clear();
  }
  return commands;
}

// Property: the README tells the truth.
TEST(Readme, EveryCommandItShowsSucceeds) {
  const TemporaryFolder folder;
  fs::create_symlink(fs::path(GHTRACK_SOURCE_DIR) / "scenes", folder.path() / "scenes");
  const auto commands = shown_commands(fs::path(GHTRACK_SOURCE_DIR) / "README.md");
  ASSERT_GE(commands.size(), 5U);
  for (const std::string& command : commands) {
    const bool starts_mpi = command.starts_with("mpirun ");  // Open MPI itself leaks
    const Outcome outcome =
        shell((starts_mpi ? "ASAN_OPTIONS=detect_leaks=0 " : "") + command, folder.path());
    const bool needs_wasm = outcome.err.find("compiler for WebAssembly") != std::string::npos;
    EXPECT_EQ(outcome.exit_code, needs_wasm ? 1 : 0) << command << "\n" << outcome.err;
  }
}

}  // namespace
}  // namespace ghtrack::testing

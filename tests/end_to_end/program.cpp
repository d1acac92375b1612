#include "tests/end_to_end/program.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "tests/effort.hpp"

namespace ghtrack::testing {

namespace fs = std::filesystem;

namespace {

/// Lets mpirun start ranks as root, and more of them than there are processors.
constexpr const char* kMpiEnvironment =
    "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
    "OMPI_MCA_rmaps_base_oversubscribe=1 && ";

}  // namespace

Outcome shell(const std::string& command, const fs::path& folder) {
  const TemporaryFolder streams;
  const fs::path out = streams.path() / "out";
  const fs::path err = streams.path() / "err";
  const std::string line = "cd '" + folder.string() + "' && unset DISPLAY && export PATH='" +
                           std::string(GHTRACK_PROGRAM_DIR) + "':\"$PATH\" && " + kMpiEnvironment +
                           "{ " + command + "\n} >'" + out.string() + "' 2>'" + err.string() +
                           "' </dev/null";
  const int status =
      std::system(line.c_str());  // NOLINT(cert-env33-c): tests run a shell on purpose
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {exit_code, contents(out), contents(err)};
}

std::string affordable(const std::string& example) {
  static const std::regex runs("--runs [0-9]+");
  return kSanitized ? std::regex_replace(example, runs, "--runs 5") : example;
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "ghtrack-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::vector<std::string>> csv_rows(const fs::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(contents(file));
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string> cells;
    std::istringstream cell_text(line);
    for (std::string cell; std::getline(cell_text, cell, ',');) cells.push_back(cell);
    if (!line.empty() && line.back() == ',') cells.emplace_back();
    rows.push_back(cells);
  }
  return rows;
}

fs::path scene_file(const std::string& name) {
  return fs::path(GHTRACK_SOURCE_DIR) / "scenes" / name;
}

}  // namespace ghtrack::testing

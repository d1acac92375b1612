#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ghtrack::testing {

/// What a finished program left behind.
struct Outcome {
  int exit_code = 0;  // 128 + N if signal N ended it
  std::string out;
  std::string err;
};

/// Runs a shell command in a folder, with `ghtrack` first on the PATH and without a display.
Outcome shell(const std::string& command, const std::filesystem::path& folder);

/// An example as it is typed; in the slow builds of the sanitizers with few of its runs.
std::string affordable(const std::string& example);

/// A fresh folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Bytes of a file.
std::string contents(const std::filesystem::path& file);

void write(const std::filesystem::path& file, const std::string& text);

/// Names of the files in a folder, sorted.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// A CSV file without quoted cells: rows of cells, the header first.
std::vector<std::vector<std::string>> csv_rows(const std::filesystem::path& file);

/// A scene that ships with the project.
std::filesystem::path scene_file(const std::string& name);

}  // namespace ghtrack::testing

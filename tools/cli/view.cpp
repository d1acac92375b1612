// `ghtrack view`: starts ghtrack-view, which lies beside this program and links what a window
// needs.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/cli/commands.hpp"
#include "tools/cli/scene_source.hpp"

namespace ghtrack::cli {

int view(const ViewOptions& options) {
  const std::string& file = options.scene.files.front();
  load_scene(file, options.scene);  // what is wrong with it is said before any window opens
  const auto program =
      std::filesystem::read_symlink("/proc/self/exe").replace_filename("ghtrack-view");
  std::vector<std::string> words{program.string(), file};
  for (const std::string& change : options.scene.all_overrides()) {
    words.insert(words.end(), {"--set", change});
  }
  if (!options.screenshot.empty()) {
    words.insert(words.end(), {"--screenshot", options.screenshot});
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  throw std::runtime_error(fmt::format("view: cannot start '{}': {}; build or install it",
                                       program.string(), std::strerror(errno)));
}

}  // namespace ghtrack::cli

// `ghtrack view`: a page on which a scene can be played with.

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <variant>

#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/page_file.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/record/result_folder.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

bool is_set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// Asks the desktop to show the page. False where there is none to ask.
bool open_in_browser(const fs::path& page) {
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY") && !is_set("BROWSER")) return false;
  const std::string address = fs::absolute(page).string();
  std::string opener = "xdg-open", argument = address;
  const std::array<char*, 3> words = {opener.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t quietly;
  ::posix_spawn_file_actions_init(&quietly);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    ::posix_spawn_file_actions_addopen(&quietly, stream, "/dev/null", O_RDWR, 0);
  }
  pid_t child = 0;
  const int failed =
      ::posix_spawnp(&child, opener.c_str(), &quietly, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&quietly);
  return failed == 0;
}

}  // namespace

int view(const ViewOptions& options, const Manners& manners) {
  const std::string& file = options.scene.files.front();
  const Scene scene = load_scene(file, options.scene);
  fs::path path = options.output;
  if (path.empty()) {
    const fs::path folder = default_folder(name_of(scene), file);
    make_folder(folder);
    path = folder / "page.html";
  }
  write_page(scene, options.scene, path);
  if (path == "-") return 0;
  const bool is_open = !options.stay && open_in_browser(path);
  if (!manners.quiet) {
    tell("{}: {}{}", name_of(scene), path.string(),
         is_open || options.stay ? "" : "; open it in a browser");
  }
  return 0;
}

}  // namespace ghtrack::cli

#include "tools/cli/page_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "tools/cli/interruption.hpp"
#include "tools/page/page.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/run/series_file.hpp"

namespace ghtrack::cli {
namespace {

/// A word as a shell reads it.
std::string quoted(const std::string& word) {
  const std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'') {
      text += "'\\''";
    } else {
      text += c;
    }
  }
  return text + "'";
}

/// The command that runs the scene as it was chosen.
std::string run_command(const SceneOptions& options) {
  std::string command = "ghtrack run " + quoted(options.files.front());
  for (const std::string& change : options.overrides) command += " --set " + quoted(change);
  if (!options.seed.empty()) command += " --seed " + quoted(options.seed);
  if (!options.duration.empty()) command += " --duration " + quoted(options.duration);
  return command;
}

}  // namespace

const std::string& name_of(const Scene& scene) {
  return std::visit([](const auto& s) -> const std::string& { return s.name; }, scene);
}

void write_page(const Scene& scene, const SceneOptions& options,
                const std::filesystem::path& path) {
  const page::PageOptions page_options{.command = run_command(options)};
  if (const auto* world = std::get_if<WorldScene>(&scene)) {
    write_file(path, page::scene_page(*world, page_options, stop_if_interrupted));
  } else {
    write_file(
        path, page::series_page(with_own_measurements(std::get<SeriesScene>(scene)), page_options));
  }
}

}  // namespace ghtrack::cli

#include "tools/cli/scene_source.hpp"

#include <cctype>

#include "scenes/schema/reader.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/run/series_file.hpp"

namespace ghtrack::cli {
namespace {

constexpr std::size_t kLongestFolderName = 100;

/// Letters, digits and single underscores: a name that is harmless in every file system.
std::string plain_name(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && std::isalnum(byte) != 0) {
      plain += static_cast<char>(std::tolower(byte));
    } else if (!plain.empty() && plain.back() != '_') {
      plain += '_';
    }
    if (plain.size() == kLongestFolderName) break;
  }
  while (!plain.empty() && plain.back() == '_') plain.pop_back();
  return plain;
}

}  // namespace

std::vector<std::string> SceneOptions::all_overrides() const {
  std::vector<std::string> all = overrides;
  if (!seed.empty()) all.push_back("--seed=" + seed);
  if (!duration.empty()) all.push_back("--duration=" + duration);
  return all;
}

Scene load_scene(const std::string& file, const SceneOptions& options, const Manners& manners) {
  Scene scene = read_scene(file, options.all_overrides());
  if (auto* const series = std::get_if<SeriesScene>(&scene)) {
    const auto folder = std::filesystem::path(file == "-" ? "" : file).parent_path();
    for (const std::string& remark : read_measurements(*series, folder, stop_if_interrupted)) {
      if (!manners.quiet) tell("ghtrack: {}", remark);
    }
  }
  return scene;
}

std::filesystem::path default_folder(const std::string& scene_name, const std::string& file) {
  std::string name = plain_name(scene_name);
  if (name.empty()) name = plain_name(std::filesystem::path(file).stem().string());
  return std::filesystem::path("out") / (name.empty() ? "scene" : name);
}

std::filesystem::path folder_named(const std::string& output) {
  if (output == "-") {
    throw UsageError("-o '-': results are several files, which need a folder");
  }
  return output;
}

}  // namespace ghtrack::cli

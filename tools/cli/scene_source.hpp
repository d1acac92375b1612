#pragma once

#include <filesystem>
#include <string>

#include "scenes/schema/scene.hpp"
#include "tools/cli/commands.hpp"

namespace ghtrack::cli {

/// Reads a scene file with the changes that the options ask for.
Scene load_scene(const std::string& file, const SceneOptions& options);

/// The folder for the results of a scene: out/<its name in plain letters>.
std::filesystem::path default_folder(const std::string& scene_name, const std::string& file);

/// Makes a folder and its parents.
/// @throws WriteError naming the folder and the reason
void make_folder(const std::filesystem::path& folder);

}  // namespace ghtrack::cli

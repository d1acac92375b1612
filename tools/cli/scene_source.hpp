#pragma once

#include <filesystem>
#include <string>

#include "scenes/schema/scene.hpp"
#include "tools/cli/commands.hpp"

namespace ghtrack::cli {

/// Reads a scene file with the changes that the options ask for, and the measurements of a series
/// that names a file of them; says what was read unless it is to be quiet.
Scene load_scene(const std::string& file, const SceneOptions& options,
                 const Manners& manners = {.quiet = true});

/// The folder for the results of a scene: out/<its name in plain letters>.
std::filesystem::path default_folder(const std::string& scene_name, const std::string& file);

/// The folder that was given for results.
/// @throws UsageError for `-`: results are files
std::filesystem::path folder_named(const std::string& output);

}  // namespace ghtrack::cli

#pragma once

#include <filesystem>
#include <string>

#include "scenes/schema/scene.hpp"
#include "tools/cli/commands.hpp"

namespace ghtrack::cli {

/// What a scene calls itself.
const std::string& name_of(const Scene& scene);

/// Writes the page of a scene.
/// @param options  what chose the scene: the page says how to run it
/// @throws std::runtime_error if this program cannot make pages, or the file cannot be written
void write_page(const Scene& scene, const SceneOptions& options, const std::filesystem::path& path);

}  // namespace ghtrack::cli

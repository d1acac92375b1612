#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/scene.hpp"

namespace ghtrack {

/// Reads and checks a scene file: strict YAML, every key known, every number finite and in bounds.
/// @param overrides  "KEY=VALUE" each, such as "targets[0].ball.mass=0.2" or
///                   "targets[express].train.speed=20": applied to the file's text before it is
///                   checked; a value is written as in the file
/// @throws SceneError with all that is wrong, and where
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for a text that is already in memory; `name` stands for the file in messages.
Scene read_scene_text(std::string_view text, const std::string& name,
                      std::span<const std::string> overrides = {});

/// Where a key stands, such as "scenes/demo.yaml:4:5" for "targets[0].ball", or what is there of
/// it; the name alone of standard input and of what a file does not say.
std::string place_of(const std::filesystem::path& file, std::string_view key);

}  // namespace ghtrack

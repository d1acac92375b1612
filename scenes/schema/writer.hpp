#pragma once

#include <string>

#include "scenes/schema/scene.hpp"

namespace ghtrack {

/// The scene as a file with every default spelled out. It reads back to the same scene, and the
/// same scene always gives the same bytes; numbers are the shortest that read back unchanged.
std::string write_scene(const Scene& scene);

/// JSON Schema (draft-07) of scene files, for editors: what `ghtrack schema` prints.
std::string scene_json_schema();

/// The reference of scene files in Markdown: every key, its unit, default, bounds and meaning.
std::string scene_reference();

}  // namespace ghtrack

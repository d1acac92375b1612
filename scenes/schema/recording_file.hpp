#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/target.hpp"

namespace ghtrack::schema {

/// Reads the tables of recorded targets into their `places`, so that the scene no longer needs
/// them: comma-separated, with a header that names the columns t (or time), x and y, in any order
/// and among others; `id` is looked for in truth_id, track_id, id or name.
/// @param folder  from which relative names are counted
/// @throws SceneError naming the table, line and column, what was found and what is allowed
void read_recordings(std::vector<Target>& targets, const std::filesystem::path& folder);

}  // namespace ghtrack::schema

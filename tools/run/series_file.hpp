#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scenes/schema/series.hpp"

namespace ghtrack {

/// Fills in the measurements, truth and times of a scene that names a file of them; its dt becomes
/// the typical time between them. Other scenes stay as they are.
/// @param folder  from which the file's place is counted
/// @param pause   called while reading; may throw
/// @return what was read and how, line by line
/// @throws InputError naming file, line, column, what was found and what is allowed
std::vector<std::string> read_measurements(SeriesScene& scene, const std::filesystem::path& folder,
                                           const std::function<void()>& pause = {});

/// The same scene with the measurements of its file written out in it; those that were missed are
/// left out, which their times tell.
SeriesScene with_own_measurements(SeriesScene scene);

}  // namespace ghtrack

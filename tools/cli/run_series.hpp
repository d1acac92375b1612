#pragma once

#include <filesystem>

#include "scenes/schema/series.hpp"

namespace ghtrack::cli {

/// Runs the filters of a series scene and writes their results into a folder that exists.
void run_series(const SeriesScene& scene, const std::filesystem::path& folder);

}  // namespace ghtrack::cli

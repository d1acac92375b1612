#pragma once

#include "scenes/schema/series.hpp"
#include "tools/record/result_folder.hpp"

namespace ghtrack::cli {

/// Runs the filters of a series scene and writes their results into a folder.
void run_series(const SeriesScene& scene, ResultFolder& results);

}  // namespace ghtrack::cli

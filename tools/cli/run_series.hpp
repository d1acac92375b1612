#pragma once

#include "scenes/schema/series.hpp"
#include "tools/plot/series_figure.hpp"
#include "tools/record/result_folder.hpp"

namespace ghtrack::cli {

/// What a figure says of a series, and how it is to be drawn.
plot::SeriesLabels labels_of(const SeriesScene& scene);

/// Runs the filters of a series scene and writes their results into a folder.
/// @param plots  also write plots.svg
void run_series(const SeriesScene& scene, ResultFolder& results, bool plots);

}  // namespace ghtrack::cli

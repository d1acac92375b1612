#pragma once

#include "scenes/schema/series.hpp"
#include "tools/render/plot.hpp"
#include "tools/run/series.hpp"

namespace ghtrack::film {

/// The plot of a series scene: truth, measurements, and what each filter makes of them.
render::Plot plot_of(const SeriesScene& scene, const SeriesResult& result);

}  // namespace ghtrack::film

#pragma once

#include <string>

#include "scenes/schema/series.hpp"
#include "tools/run/series.hpp"

namespace ghtrack::film {

/// Beliefs over time as a picture in SVG: a panel for each histogram filter, a column for each
/// measurement, a row for each place, the darker the likelier; a ring marks where it was in truth.
/// Empty if no filter of the scene has a belief.
std::string belief_picture(const SeriesScene& scene, const SeriesResult& result);

}  // namespace ghtrack::film

#pragma once

#include <string>

#include "tools/plot/figure.hpp"

namespace ghtrack::plot {

/// Whether a file is what `ghtrack filter` or a series scene writes.
bool is_series_file(const std::string& path);

/// A filtered series: measurements, estimates and truth; residuals with twice their root mean
/// square; errors, where there is a truth; and the rate. Each axis of a vector has its own panels.
/// @throws InputError
Figure figure_of_series(const std::string& path, const std::string& title);

}  // namespace ghtrack::plot

#pragma once

#include <map>
#include <optional>
#include <string>

#include "tools/plot/figure.hpp"

namespace ghtrack::plot {

/// Whether a file is what `ghtrack filter` or a series scene writes.
bool is_series_file(const std::string& path);

/// What a series is called.
struct SeriesLabels {
  std::string title = {};
  std::string time = "t [s]";
  std::string value = "x";
  std::map<std::string, std::string> filters = {};  // by name; others are called by that
  bool shows_measurements = true;                   // readings of another kind cannot be shown
  std::optional<double> ring = {};                  // places around which the series goes, if any
};

/// A filtered series: measurements, estimates and truth; residuals with twice their root mean
/// square; errors, where there is a truth; and the rate. Each axis of a vector has its own panels.
/// @throws InputError
Figure figure_of_series(const std::string& path, const SeriesLabels& labels = {});

}  // namespace ghtrack::plot

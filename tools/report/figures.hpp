#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/experiment/comparison.hpp"

// The charts of a comparison, as SVG. Filter i has the style class filter_class(i).

namespace ghtrack::report {

/// "s1" … "s7", then "s1 again" …: as many as can be told apart by colour, then by dashes.
std::string filter_class(std::size_t filter);

/// Truth, detections and estimates of the example run, seen from where the world is drawn; absent
/// without truth.
/// @param most_points  of each kind: lines and dots beyond are simplified and thinned out
std::optional<std::string> overlay_figure(const ComparedCell& cell, std::size_t most_points);

/// RMSE over time of all filters in one regime, with the band of the runs.
std::optional<std::string> error_figure(const Comparison& comparison, const ComparedCell& cell,
                                        const std::string& regime);
/// The same numbers for a script: {"labels", "classes", "rows": [[t, [low, rmse, high], …], …]}.
nlohmann::json error_data(const Comparison& comparison, const ComparedCell& cell,
                          const std::string& regime);

/// Predicted against measured RMSE of position, a point for each filter and regime of all cells.
std::optional<std::string> prediction_figure(const Comparison& comparison);

/// The expected error over g and h.
/// @param filters  names of the filters that the surface marks
std::optional<std::string> surface_figure(const std::vector<std::string>& filters,
                                          const GainSurface& surface);
/// The least error of a surface [m]; NaN if all gains are unstable.
double least_error(const GainSurface& surface);

/// Shades of a gain surface, from the least error to kWorstShown times as much.
inline constexpr int kShades = 8;
inline constexpr double kWorstShown = 8.0;

}  // namespace ghtrack::report

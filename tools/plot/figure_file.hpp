#pragma once

#include <filesystem>

#include "tools/plot/figure.hpp"

namespace ghtrack::plot {

/// Whether figures can be written under that name: it ends in .svg, .pdf or .png.
bool is_figure_file(const std::filesystem::path& path);

/// Draws a figure into a file. The same figure gives the same bytes.
/// @throws WriteError if it cannot be written
void write_figure(const std::filesystem::path& path, const Figure& figure, const Style& style);

}  // namespace ghtrack::plot

#pragma once

#include <opencv2/core/mat.hpp>

#include "tools/render/plot.hpp"

namespace ghtrack::render {

/// Draws a plot: 8 bit BGR, of the plot's size.
cv::Mat draw_plot(const Plot& plot);

/// See write_plot().
void write_plot_picture(const std::filesystem::path& path, const Plot& plot);

}  // namespace ghtrack::render

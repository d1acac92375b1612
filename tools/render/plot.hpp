#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/render/errors.hpp"

namespace ghtrack::render {

/// One curve or cloud of points of a plot. Points that are not finite are gaps.
struct PlotSeries {
  enum class Style {
    kTruth,        // a black line
    kMeasurement,  // small grey circles, not joined
    kPrediction,   // a dotted line in the colour of the estimate of the same filter
    kEstimate,     // a line in a colour of its own
  };
  std::string name;  // for the legend
  Style style = Style::kEstimate;
  std::vector<double> x;
  std::vector<double> y;  // as many as x
  int filter = 0;         // chooses the colour of predictions and estimates
};

/// A picture to paste into a report: white ground, axes with round numbers, a legend.
struct Plot {
  std::string title;
  std::string x_label = "t [s]";
  std::string y_label;
  std::vector<PlotSeries> series;
  int width = 1200;  // [px]
  int height = 750;  // [px]
};

/// Writes the plot as a PNG file, under the same rules for its name as a video's.
/// @throws RequestError for a bad name, size or series of unequal lengths
/// @throws OutputError if it cannot be written
void write_plot(const std::filesystem::path& path, const Plot& plot);

}  // namespace ghtrack::render

#include "tools/film/series_plot.hpp"

#include <string>
#include <utility>
#include <variant>

namespace ghtrack::film {
namespace {

using render::PlotSeries;

constexpr std::size_t kMostWithPredictions = 2;  // filters in one plot, or it gets crowded

PlotSeries curve(const SeriesTrack& track, PlotSeries::Style style, std::string name, int filter,
                 double SeriesRow::*value) {
  PlotSeries series{.name = std::move(name), .style = style, .x = {}, .y = {}, .filter = filter};
  for (const SeriesRow& row : track.rows) {
    series.x.push_back(row.t);
    series.y.push_back(row.*value);
  }
  return series;
}

}  // namespace

render::Plot plot_of(const SeriesScene& scene, const SeriesResult& result) {
  render::Plot plot;
  plot.title = scene.name;
  plot.x_label = scene.plot.x_label;
  plot.y_label = scene.plot.y_label;
  const SeriesTrack& first = result.tracks.front();
  if (first.rows.front().truth) {
    PlotSeries truth{.name = "truth", .style = PlotSeries::Style::kTruth, .x = {}, .y = {}};
    for (const SeriesRow& row : first.rows) {
      truth.x.push_back(row.t);
      truth.y.push_back(*row.truth);
    }
    plot.series.push_back(std::move(truth));
  }
  if (!std::holds_alternative<WalkSeries>(scene.data)) {  // whose readings are not places
    plot.series.push_back(
        curve(first, PlotSeries::Style::kMeasurement, "measurements", 0, &SeriesRow::z));
  }
  int index = 0;
  for (const SeriesTrack& track : result.tracks) {
    if (result.tracks.size() <= kMostWithPredictions) {
      plot.series.push_back(curve(track, PlotSeries::Style::kPrediction,
                                  track.filter + ", predicted", index, &SeriesRow::x_pred));
    }
    plot.series.push_back(curve(track, PlotSeries::Style::kEstimate,
                                track.filter + " (" + track.gains + ")", index, &SeriesRow::x));
    ++index;
  }
  return plot;
}

}  // namespace ghtrack::film

// `ghtrack run` for a series scene: series.csv, metrics.json, plot.png and a table.

#include "tools/cli/run_series.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <variant>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/writer.hpp"
#include "tools/pipeline/series.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/render/plot.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using render::PlotSeries;

constexpr std::size_t kMostWithPredictions = 2;  // filters in one plot, or it gets crowded

std::string as_csv(const SeriesResult& result) {
  CsvRow csv;
  for (const char* name : {"filter", "k", "t", "z", "x_pred", "dx_pred", "residual", "x", "dx",
                           "ddx_pred", "ddx", "truth"}) {
    csv << name;
  }
  csv.end();
  for (const SeriesTrack& track : result.tracks) {
    for (const SeriesRow& row : track.rows) {
      csv << track.filter << row.k << row.t << row.z << row.x_pred << row.dx_pred << row.residual
          << row.x << row.dx << row.ddx_pred << row.ddx << row.truth;
      csv.end();
    }
  }
  return csv.text();
}

ordered_json number(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json as_json(const SeriesScene& scene, const SeriesResult& result) {
  ordered_json json = {{"scene", scene.name},
                       {"measurement_rmse", number(result.measurement_rmse)},
                       {"filters", ordered_json::array()}};
  for (const SeriesTrack& track : result.tracks) {
    json["filters"].push_back({{"name", track.filter},
                               {"gains", track.gains},
                               {"n", track.rows.size()},
                               {"rmse", number(track.rmse)},
                               {"rmse_without_guess", number(track.rmse_without_guess)},
                               {"mai", track.mai}});
  }
  return json;
}

std::string as_table(const SeriesResult& result) {
  std::size_t width = 6;
  for (const SeriesTrack& track : result.tracks) width = std::max(width, track.filter.size());
  width = std::min<std::size_t>(width, 40);
  const auto cell = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : std::string("-");
  };
  std::string table =
      fmt::format("{:<{}}  {:<28}{:>12}{:>12}\n", "filter", width, "gains", "RMSE", "MAI");
  for (const SeriesTrack& track : result.tracks) {
    table += fmt::format("{:<{}.{}}  {:<28}{:>12}{:>12.4g}\n", printable(track.filter), width,
                         width, track.gains, cell(track.rmse), track.mai);
  }
  return table + fmt::format("{:<{}}  {:<28}{:>12}\n", "(measurements)", width, "",
                             cell(result.measurement_rmse));
}

PlotSeries curve(const SeriesTrack& track, PlotSeries::Style style, std::string name, int filter,
                 double SeriesRow::*value) {
  PlotSeries series{.name = std::move(name), .style = style, .x = {}, .y = {}, .filter = filter};
  for (const SeriesRow& row : track.rows) {
    series.x.push_back(row.t);
    series.y.push_back(row.*value);
  }
  return series;
}

render::Plot as_plot(const SeriesScene& scene, const SeriesResult& result) {
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
  plot.series.push_back(
      curve(first, PlotSeries::Style::kMeasurement, "measurements", 0, &SeriesRow::z));
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

}  // namespace

void run_series(const SeriesScene& scene, const fs::path& folder) {
  const SeriesResult result = ghtrack::run(scene);
  render::write_plot(folder / "plot.png", as_plot(scene, result));
  write_file(folder / "scene.yaml", write_scene(scene));
  write_file(folder / "metrics.json", as_json(scene, result).dump(2) + "\n");
  write_file(folder / "series.csv", as_csv(result));
  fmt::print("{}", as_table(result));
}

}  // namespace ghtrack::cli

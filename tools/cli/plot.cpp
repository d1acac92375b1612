// `ghtrack plot`: a run, tracks, a series or a comparison as a figure.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <variant>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/reader.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/data_source.hpp"
#include "tools/cli/paths.hpp"
#include "tools/cli/run_series.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/plot/figure_file.hpp"
#include "tools/plot/series_figure.hpp"
#include "tools/plot/study_figure.hpp"
#include "tools/plot/track_figure.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/mot_file.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

/// The cut-off that a run was scored with.
double cutoff_of_run(const fs::path& folder) {
  std::ifstream metrics(folder / "metrics.json");
  if (!metrics) return 0.0;
  const auto json = nlohmann::json::parse(metrics, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("parameters")) return 0.0;
  const auto found = json["parameters"].find("gospa_c");
  return found != json["parameters"].end() && found->is_number() ? found->get<double>() : 0.0;
}

/// As the scene of a run says, beside its results.
plot::SeriesLabels labels_of_run(const fs::path& folder, const std::string& title) {
  plot::SeriesLabels labels;
  if (const fs::path file = folder / "scene.yaml"; is_there(file)) {
    const Scene scene = read_scene(file.string());
    if (const auto* const series = std::get_if<SeriesScene>(&scene)) labels = labels_of(*series);
  }
  labels.title = title;
  return labels;
}

plot::Figure figure_of(const PlotOptions& options) {
  const fs::path source = options.source;
  std::error_code ignored;
  const bool is_run = fs::is_directory(source, ignored);
  if (is_run && is_there(source / "comparison.json")) {
    return plot::figure_of_study((source / "comparison.json").string(), options.title);
  }
  if (!is_run && plot::is_comparison_file(source.string())) {
    return plot::figure_of_study(source.string(), options.title);
  }
  if (is_run && is_there(source / "series.csv")) {
    return plot::figure_of_series((source / "series.csv").string(),
                                  labels_of_run(source, options.title));
  }
  if (is_run && !is_there(source / "tracks.csv")) {
    throw InputError(
        source.string() +
        ": error: the folder holds none of tracks.csv, series.csv and comparison.json");
  }
  if (!is_run && !looks_like_mot_file(source) && plot::is_series_file(source.string())) {
    return plot::figure_of_series(source.string(), {.title = options.title});
  }
  plot::TrackPlot tracks{.tracks = (is_run ? source / "tracks.csv" : source).string(),
                         .truth = options.truth,
                         .detections = options.detections,
                         .panels = options.panels,
                         .title = options.title,
                         .reading = read_options(options.data)};
  if (is_run) {
    tracks.cutoff = cutoff_of_run(source);
    if (tracks.truth.empty() && is_there(source / "truth.csv")) {
      tracks.truth = (source / "truth.csv").string();
    }
    if (tracks.detections.empty() && is_there(source / "detections.csv")) {
      tracks.detections = (source / "detections.csv").string();
    }
  }
  return plot::figure_of(tracks);
}

}  // namespace

int plot(const PlotOptions& options) {
  if (!plot::is_figure_file(options.output)) {
    throw UsageError(
        fmt::format("plot: '{}' must end in .svg, .pdf or .png", printable(options.output)));
  }
  const std::vector<std::string>& known = plot::track_panels();
  for (const std::string& name : options.panels) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::vector<std::string_view> names(known.begin(), known.end());
    throw UsageError(fmt::format("plot: there is no panel '{}'{}", printable(name),
                                 hint(name, "panels", names)));
  }
  const plot::Figure figure = figure_of(options);
  if (figure.panels.empty()) {
    throw InputError(options.source + ": error: the data give none of the panels asked for");
  }
  plot::Style style = plot::style_named(options.size).value();
  style.dark = options.dark;
  plot::write_figure(options.output, figure, style);
  return 0;
}

}  // namespace ghtrack::cli

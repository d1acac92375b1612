// `ghtrack run` for a series scene: series.csv, metrics.json, plot.png and a table.

#include "tools/cli/run_series.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/writer.hpp"
#include "tools/cli/messages.hpp"
#include "tools/film/belief_plot.hpp"
#include "tools/plot/figure_file.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/run/series.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// A missed measurement is an empty cell.
std::optional<double> measured(double z) { return std::isnan(z) ? std::nullopt : std::optional(z); }

std::string as_csv(const SeriesResult& result) {
  CsvRow csv;
  for (const char* name : {"filter", "k", "t", "z", "x_pred", "dx_pred", "residual", "x", "dx",
                           "ddx_pred", "ddx", "truth"}) {
    csv << name;
  }
  csv.end();
  for (const SeriesTrack& track : result.tracks) {
    for (const SeriesRow& row : track.rows) {
      csv << track.filter << row.k << row.t << measured(row.z) << row.x_pred << row.dx_pred
          << row.residual << row.x << row.dx << row.ddx_pred << row.ddx << row.truth;
      csv.end();
    }
  }
  return csv.text();
}

/// What each histogram filter believes before and after each measurement; empty without any.
std::string beliefs_as_csv(const SeriesResult& result) {
  CsvRow csv;
  bool has_beliefs = false;
  for (const char* name : {"filter", "k", "place", "prior", "posterior"}) csv << name;
  csv.end();
  for (const SeriesTrack& track : result.tracks) {
    for (std::size_t i = 0; i < track.beliefs.size(); ++i) {
      const auto& [prior, posterior] = track.beliefs[i];
      for (std::size_t place = 0; place < posterior.size(); ++place) {
        csv << track.filter << track.rows[i].k << static_cast<int>(place) << prior[place]
            << posterior[place];
        csv.end();
        has_beliefs = true;
      }
    }
  }
  return has_beliefs ? csv.text() : std::string();
}

/// How likely each of several models is after each measurement; empty without any.
std::string models_as_csv(const SeriesResult& result) {
  CsvRow csv;
  bool has_models = false;
  for (const char* name : {"filter", "k", "model", "probability"}) csv << name;
  csv.end();
  for (const SeriesTrack& track : result.tracks) {
    const auto& [names, probabilities] = track.models;
    for (std::size_t i = 0; i < probabilities.size(); ++i) {
      for (std::size_t model = 0; model < names.size(); ++model) {
        csv << track.filter << track.rows[i].k << names[model] << probabilities[i][model];
        csv.end();
        has_models = true;
      }
    }
  }
  return has_models ? csv.text() : std::string();
}

/// The measurements of a file, and the scene that reads them from beside itself.
void write_measurements(const fs::path& folder, SeriesScene& scene, const SeriesResult& result) {
  auto* const given = std::get_if<GivenSeries>(&scene.data);
  if (given == nullptr || given->file.empty()) return;
  CsvRow csv;
  if (!given->times.empty()) csv << "t";
  csv << "z";
  if (!given->truth.empty()) csv << "truth";
  csv.end();
  for (const SeriesMeasurement& row : result.measurements) {
    if (row.time) csv << *row.time;
    csv << measured(row.z);
    if (row.truth) csv << *row.truth;
    csv.end();
  }
  write_file(folder / "measurements.csv", csv.text());
  *given = {};
  given->file = "measurements.csv";
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

/// Measurements, estimates and truth, residuals and errors.
plot::Figure figure_of(const SeriesScene& scene, const SeriesResult& result, const fs::path& csv) {
  plot::SeriesLabels labels = labels_of(scene);
  for (const SeriesTrack& track : result.tracks) {
    labels.filters[track.filter] = fmt::format("{} ({})", track.filter, track.gains);
  }
  return plot::figure_of_series(csv.string(), labels);
}

}  // namespace

plot::SeriesLabels labels_of(const SeriesScene& scene) {
  return {.title = scene.name,
          .time = scene.plot.x_label,
          .value = scene.plot.y_label,
          .shows_measurements = !is_of_readings(scene),
          .ring = ring_of(scene)};
}

void run_series(const SeriesScene& scene, ResultFolder& results, bool plots) {
  const fs::path& folder = results.scratch();
  const SeriesResult result = ghtrack::run(scene);
  SeriesScene resolved = scene;
  write_measurements(folder, resolved, result);
  write_file(folder / "scene.yaml", write_scene(resolved));
  write_file(folder / "metrics.json", as_json(scene, result).dump(2) + "\n");
  write_file(folder / "series.csv", as_csv(result));
  if (const std::string beliefs = beliefs_as_csv(result); !beliefs.empty()) {
    write_file(folder / "belief.csv", beliefs);
    write_file(folder / "belief.svg", film::belief_picture(scene, result));
  }
  if (const std::string models = models_as_csv(result); !models.empty()) {
    write_file(folder / "models.csv", models);
  }
  const plot::Figure figure = figure_of(scene, result, folder / "series.csv");
  plot::write_figure(folder / "plot.png", figure, {});
  if (plots) plot::write_figure(folder / "plots.svg", figure, {});
  results.commit();
  print(as_table(result));
}

}  // namespace ghtrack::cli

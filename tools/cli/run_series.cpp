// `ghtrack run` for a series scene: series.csv, metrics.json, plot.png and a table.

#include "tools/cli/run_series.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <variant>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/writer.hpp"
#include "tools/cli/messages.hpp"
#include "tools/film/belief_plot.hpp"
#include "tools/film/series_plot.hpp"
#include "tools/run/series.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/render/plot.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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

}  // namespace

void run_series(const SeriesScene& scene, ResultFolder& results) {
  const fs::path& folder = results.scratch();
  const SeriesResult result = ghtrack::run(scene);
  render::write_plot(folder / "plot.png", film::plot_of(scene, result));
  write_file(folder / "scene.yaml", write_scene(scene));
  write_file(folder / "metrics.json", as_json(scene, result).dump(2) + "\n");
  write_file(folder / "series.csv", as_csv(result));
  if (const std::string beliefs = beliefs_as_csv(result); !beliefs.empty()) {
    write_file(folder / "belief.csv", beliefs);
    write_file(folder / "belief.svg", film::belief_picture(scene, result));
  }
  results.commit();
  print(as_table(result));
}

}  // namespace ghtrack::cli

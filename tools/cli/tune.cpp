// `ghtrack tune`: the best gains for each regime of a scene.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/experiment/gain_search.hpp"
#include "tools/experiment/tuning.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/record/result_folder.hpp"
#include "tools/report/report.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

TuningOptions tuning_options(const TuneOptions& options) {
  TuningOptions tuning;
  tuning.runs = options.runs;
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  tuning.jobs = options.jobs.value_or(std::max(1, processors));
  if (options.filter == "gh") {
    tuning.orders = {1};
  } else if (options.filter == "ghk") {
    tuning.orders = {2};
  } else if (!options.filter.empty()) {
    throw UsageError(
        fmt::format("tune: --filter is '{}'; allowed are gh and ghk", printable(options.filter)));
  }
  if (options.design.empty()) return tuning;
  const std::vector<std::string_view> rules = rules_with_a_family();
  if (std::find(rules.begin(), rules.end(), options.design) == rules.end()) {
    throw UsageError(fmt::format("tune: unknown rule '{}'{}", printable(options.design),
                                 hint(options.design, "rules", rules)));
  }
  tuning.rule = options.design;
  return tuning;
}

std::string surface_csv(const GainSurface& surface) {
  std::string text = "g,h,expected_rmse\n";
  CsvRow row;
  for (std::size_t i = 0; i < surface.g.size(); ++i) {
    for (std::size_t j = 0; j < surface.h.size(); ++j) {
      row.clear();
      row << surface.g[i] << surface.h[j] << surface.rmse[i * surface.h.size() + j];
      row.end();
      text += row.text();
    }
  }
  return text;
}

}  // namespace

int tune(const TuneOptions& options, const Manners& manners) {
  const std::string& file = options.scene.files.front();
  const fs::path folder = folder_named(options.output);
  const TuningOptions wanted = tuning_options(options);
  const Scene any_scene = load_scene(file, options.scene);
  const auto* scene = std::get_if<WorldScene>(&any_scene);
  if (scene == nullptr) {
    throw UsageError(
        fmt::format("tune: {} is a series; gains are tuned in a world", printable(file)));
  }
  const Tuning tuning = ghtrack::tune(*scene, wanted, stop_if_interrupted);
  if (!folder.empty()) {
    ResultFolder results(folder);
    write_file(results.scratch() / "tuning.json", to_json(tuning).dump(2) + "\n");
    write_file(results.scratch() / "gains.yaml", scene_fragment(tuning));
    write_file(results.scratch() / "report.html", tuning_report(tuning));
    for (const GainSurface& surface : tuning.surfaces) {
      write_file(results.scratch() / ("surface-" + surface.regime + ".csv"), surface_csv(surface));
    }
    results.commit();
    if (!manners.quiet) tell("results in {}", options.output);
  }
  print(to_table(tuning, terminal_width()) + "\n# the best of them, to be pasted into the scene\n" +
        scene_fragment(tuning));
  return 0;
}

}  // namespace ghtrack::cli

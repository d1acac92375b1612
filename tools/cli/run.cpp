#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/schema/writer.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/page_file.hpp"
#include "tools/cli/panels.hpp"
#include "tools/cli/run_series.hpp"
#include "tools/cli/run_watch.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/cli/video_look.hpp"
#include "tools/film/film.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/record/result_folder.hpp"
#include "tools/record/run_writer.hpp"
#include "tools/run/run.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> sensor_names(const WorldScene& scene) {
  std::vector<std::string> names;
  for (const SensorConfig& sensor : scene.sensors) names.push_back(sensor.name);
  return names;
}

void warn_of_missed_collisions(const TruthSource& truth, const WorldScene& scene) {
  if (truth.missed_collisions() == 0) return;
  tell(
      "ghtrack: warning: {} collisions were passed over, too fast for steps of 1/{} s; a higher "
      "physics.rate resolves them",
      truth.missed_collisions(), scene.physics.rate);
}

/// A scene on its way to files: its truth, its sensors, who follows, and who listens. All files
/// appear under their names when all are complete; what an interrupted run has done so far is kept
/// in partial files.
void run_world(const WorldScene& scene, ResultFolder& results, const RunOptions& options,
               const Manners& manners) {
  const fs::path& folder = results.scratch();
  const auto new_world = [&scene] { return make_world(scene); };
  SimulatedTruth simulated(new_world);
  const std::vector<ObjectInfo>& objects = simulated.objects();

  std::vector<Contender> contenders = {own_tracker(scene)};
  film::Shown shown;
  if (options.compare) {
    const std::vector<Contender> compared = filters_side_by_side(scene, "run");
    contenders.insert(contenders.end(), compared.begin(), compared.end());
    shown = {.first = 1, .count = compared.size()};
  }
  std::optional<film::Film> film;
  if (options.video.value_or(options.compare || scene.video.has_value())) {
    render::VideoOptions video = film::video_options(scene, objects, folder / "video.mp4");
    apply(options.look, video);
    film.emplace(scene, new_world, video, contenders, shown, stop_if_interrupted);
  }
  const std::vector<double> frames = film ? film->frame_times() : std::vector<double>{};

  RunWatch watch(frames.size(), manners.quiet);
  RunWriter files(folder, objects, sensor_names(scene));
  RunMetrics metrics(objects, scoring_for(traits_of(scene.sensors)));
  RunObservers observers = {&watch, &files, &metrics};
  if (film) observers.push_back(&*film);
  TruthSource& truth = film ? film->truth() : simulated;
  std::vector<RunCounts> counts;
  try {
    counts = ghtrack::run(scene, truth, contenders, observers, frames);
  } catch (Interrupted& interrupted) {
    files.keep_partial();
    nlohmann::ordered_json so_far = to_json(metrics.report());
    so_far["partial"] = true;
    write_partial_file(folder / "metrics.json", so_far.dump(2) + "\n");
    if (film) film->writer().keep_partial();
    results.keep_partial();
    interrupted.remark = fmt::format("{} holds what was done so far, in files named .partial",
                                     results.path().string());
    throw;
  }

  RunReport report = metrics.report();
  report.counts = counts.front();
  if (film) film->writer().finish();
  write_file(folder / "scene.yaml", write_scene(scene));
  write_file(folder / "metrics.json", to_json(report).dump(2) + "\n");
  files.commit();
  results.commit();
  if (!manners.quiet) warn_of_missed_collisions(truth, scene);
  print(to_table(report, terminal_width()));
}

/// Where the results of each scene go. No two scenes may share a folder.
std::vector<fs::path> folders_of(const RunOptions& options, const std::vector<Scene>& scenes) {
  const std::vector<std::string>& files = options.scene.files;
  std::vector<fs::path> folders;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const fs::path by_name = default_folder(name_of(scenes[i]), files[i]);
    folders.push_back(options.output.empty() ? by_name
                      : scenes.size() == 1   ? folder_named(options.output)
                                             : folder_named(options.output) / by_name.filename());
    const auto same = std::find(folders.begin(), folders.end() - 1, folders.back());
    if (same == folders.end() - 1) continue;
    throw UsageError(fmt::format(
        "run: '{}' and '{}' would both write into '{}': give them different names, or run them one "
        "by one with -o",
        files[static_cast<std::size_t>(same - folders.begin())], files[i],
        folders.back().string()));
  }
  return folders;
}

}  // namespace

int run(const RunOptions& options, const Manners& manners) {
  std::vector<Scene> scenes;
  for (const std::string& file : options.scene.files) {
    scenes.push_back(load_scene(file, options.scene));
  }
  const std::vector<fs::path> folders = folders_of(options, scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    ResultFolder results(folders[i]);
    if (options.page) write_page(scenes[i], options.scene_of(i), results.scratch() / "page.html");
    if (const auto* world = std::get_if<WorldScene>(&scenes[i])) {
      run_world(*world, results, options, manners);
    } else {
      run_series(std::get<SeriesScene>(scenes[i]), results);
    }
    if (!manners.quiet) {
      tell("{}: results in {}", name_of(scenes[i]), folders[i].string());
    }
  }
  return 0;
}

}  // namespace ghtrack::cli

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/writer.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/page_file.hpp"
#include "tools/cli/panels.hpp"
#include "tools/cli/passages.hpp"
#include "tools/cli/run_series.hpp"
#include "tools/cli/run_watch.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/smoothed_tracks.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/cli/video_look.hpp"
#include "tools/experiment/engine.hpp"
#include "tools/experiment/hindsight.hpp"
#include "tools/film/film.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/metrics/match_writer.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/plot/figure_file.hpp"
#include "tools/plot/track_figure.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/result_folder.hpp"
#include "tools/record/run_writer.hpp"
#include "tools/run/run.hpp"
#include "tools/run/track_history.hpp"

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
      "ghtrack: warning: {} collisions were passed over, too many for steps of 1/{} s; a higher "
      "physics.rate resolves them",
      truth.missed_collisions(), scene.physics.rate);
}

void warn_of_displacements(const TruthSource& truth) {
  for (const Displacement& displaced : truth.displacements()) {
    tell(
        "ghtrack: warning: '{}' appeared inside something at {:.6g} s and was moved out of it by "
        "{:.3g} m",
        truth.objects().at(static_cast<std::size_t>(displaced.object)).name, displaced.time,
        displaced.distance);
  }
}

void warn_of_overruns(const TruthSource& truth) {
  for (const WorldEvent& event : truth.events()) {
    const bool is_overspeed = event.kind == EventKind::kOverspeed;
    if (!is_overspeed && event.kind != EventKind::kOverrun) continue;
    tell(
        "ghtrack: warning: '{}' {} at {:.6g} s: it began to brake too late, or its brakes are too "
        "weak",
        truth.objects().at(static_cast<std::size_t>(event.object)).name,
        is_overspeed ? "ran faster than a speed limit allows" : "ran past its stop", event.time);
  }
}

void warn_of_passages(const TruthSource& truth) {
  for (const WorldEvent& event : truth.events()) {
    if (event.kind == EventKind::kPassage) {
      tell("ghtrack: warning: {}", told_of_passage(event, truth.objects()));
    }
  }
}

/// Draws the tracks of the run beside its truth and detections.
void write_plots(const fs::path& folder, const RunMetricsOptions& scoring,
                 const std::string& title) {
  const plot::Figure figure = plot::figure_of({.tracks = (folder / "tracks.csv").string(),
                                               .truth = (folder / "truth.csv").string(),
                                               .detections = (folder / "detections.csv").string(),
                                               .panels = {},
                                               .cutoff = scoring.gospa().cutoff,
                                               .title = title,
                                               .reading = {}});
  plot::write_figure(folder / "plots.svg", figure, {});
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
  const TrackColumns columns = options.plots ? innovation_columns() : TrackColumns();
  RunWriter files(folder, objects, sensor_names(scene), columns, scene.record.columns);
  const RunMetricsOptions scoring = scoring_for(traits_of(scene.sensors));
  RunMetrics metrics(objects, scoring, 0,
                     FilterTheory{contenders.front().tracker.design(), scene.sensors});
  std::optional<RunMatches> matches;
  if (options.matches) matches.emplace(folder / "matches.csv", scoring.gospa());
  LabelledObjectRecorder labelled(objects.size(), objects_for_hindsight(scene, objects.size()));
  RunObservers observers = {&watch, &files, &metrics, &labelled};
  if (matches) observers.push_back(&*matches);
  if (film) observers.push_back(&*film);
  std::optional<HistoryObserver> history;
  if (options.smooth) observers.push_back(&history.emplace(contenders.front().tracker.design(), 0));
  TruthSource& truth = film ? film->truth() : simulated;
  std::vector<RunCounts> counts;
  try {
    counts = ghtrack::run(scene, truth, contenders, observers, frames);
  } catch (Interrupted& interrupted) {
    files.keep_partial();
    nlohmann::ordered_json so_far = to_json(metrics.report());
    so_far["partial"] = true;
    write_partial_file(folder / "metrics.json", so_far.dump(2) + "\n");
    if (matches) matches->keep_partial();
    if (film) film->writer().keep_partial();
    results.keep_partial();
    interrupted.remark = fmt::format("{} holds what was done so far, in files named .partial",
                                     results.path().string());
    throw;
  }

  RunReport report = metrics.report();
  report.counts = counts.front();
  add_hindsight(report, std::move(labelled).objects(), scene, stop_if_interrupted);
  if (film) film->writer().finish();
  write_file(folder / "scene.yaml", write_scene(scene));
  AtomicFile scores(folder / "metrics.json");
  write_json(report, [&](std::string_view text) { scores.write(text); });
  scores.commit();
  files.commit();
  if (scene.record.events) write_events(folder / "events.csv", truth.events(), objects);
  if (history) write_smoothed_tracks(folder / "tracks.csv", history->history().smoothed(), columns);
  if (matches) matches->commit();
  if (options.plots) write_plots(folder, scoring, scene.name);
  results.commit();
  if (!manners.quiet) warn_of_missed_collisions(truth, scene);
  if (!manners.quiet) warn_of_displacements(truth);
  if (!manners.quiet) warn_of_overruns(truth);
  if (!manners.quiet) warn_of_passages(truth);
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
    scenes.push_back(load_scene(file, options.scene, manners));
  }
  const std::vector<fs::path> folders = folders_of(options, scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    ResultFolder results(folders[i]);
    if (options.page) write_page(scenes[i], options.scene_of(i), results.scratch() / "page.html");
    if (const auto* world = std::get_if<WorldScene>(&scenes[i])) {
      run_world(*world, results, options, manners);
    } else {
      run_series(std::get<SeriesScene>(scenes[i]), results, options.plots);
    }
    if (!manners.quiet) {
      tell("{}: results in {}", name_of(scenes[i]), folders[i].string());
    }
  }
  return 0;
}

}  // namespace ghtrack::cli

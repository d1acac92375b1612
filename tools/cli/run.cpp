#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenes/schema/writer.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/run_series.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/video_frames.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/pipeline/simulation.hpp"
#include "tools/record/run_writer.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> sensor_names(const WorldScene& scene) {
  std::vector<std::string> names;
  for (const SensorConfig& sensor : scene.sensors) names.push_back(sensor.name);
  return names;
}

/// Simulates, senses, tracks and scores; every file appears complete or not at all.
void run_world(const WorldScene& scene, const fs::path& folder, std::optional<bool> video,
               const Manners& manners) {
  World world = make_world(scene);
  RunWriter files(folder, world.objects(), sensor_names(scene));
  RunMetricsOptions scoring;
  const SensorTraits first = traits_of(scene.sensors.front());
  scoring.sigma = first.sigma;
  scoring.period = first.period;
  RunMetrics metrics(world.objects(), scoring);
  std::optional<VideoFrames> frames;
  if (video.value_or(scene.video.has_value())) {
    frames.emplace(scene, world, video_options(scene, world, folder / "video.mp4"), manners.quiet);
  }

  Listener listener;
  listener.on_observation = [&](const TruthSnapshot& truth, const Observation& observation) {
    stop_if_interrupted();
    files.add_observation(truth, observation);
    metrics.add_observation(truth, observation);
  };
  listener.on_scan = [&](const StepRecord& record) {
    files.add_tracks(record.tracks);
    metrics.add_tracks(record);
    if (frames) frames->add_scan(record);
  };
  if (frames) {
    listener.on_late_scan = [&](const Observation& late) { frames->add_late_scan(late); };
    listener.frame_times = frames->times();
    listener.on_frame = [&](const TruthSnapshot& truth) {
      stop_if_interrupted();
      frames->add_frame(truth);
    };
  }
  const RunCounts counts = ghtrack::run(scene, world, listener);

  RunReport report = metrics.report();
  report.counts = counts;
  if (frames) frames->writer().finish();
  write_file(folder / "scene.yaml", write_scene(scene));
  write_file(folder / "metrics.json", to_json(report).dump(2) + "\n");
  files.commit();
  fmt::print("{}", to_table(report));
}

}  // namespace

int run(const RunOptions& options, const Manners& manners) {
  std::vector<Scene> scenes;
  for (const std::string& file : options.scene.files) {
    scenes.push_back(load_scene(file, options.scene));
  }
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::string& name = std::visit(
        [](const auto& s) -> const auto& { return s.name; }, scenes[i]);
    const fs::path by_name = default_folder(name, options.scene.files[i]);
    const fs::path folder = options.output.empty() ? by_name
                            : scenes.size() == 1   ? fs::path(options.output)
                                                   : options.output / by_name.filename();
    make_folder(folder);
    if (const auto* world = std::get_if<WorldScene>(&scenes[i])) {
      run_world(*world, folder, options.video, manners);
    } else {
      run_series(std::get<SeriesScene>(scenes[i]), folder);
    }
    if (!manners.quiet) fmt::print(stderr, "{}: results in {}\n", name, folder.string());
  }
  return 0;
}

}  // namespace ghtrack::cli

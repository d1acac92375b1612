// `ghtrack video`: the annotated video alone.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/panels.hpp"
#include "tools/cli/run_watch.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/cli/video_look.hpp"
#include "tools/cli/video_place.hpp"
#include "tools/film/film.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/record/result_folder.hpp"
#include "tools/render/output_path.hpp"
#include "tools/run/run.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

render::Encoder parse_encoder(const std::string& name) {
  if (name == "auto") return render::Encoder::kAutomatic;
  if (name == "ffmpeg") return render::Encoder::kFfmpeg;
  if (name == "opencv") return render::Encoder::kOpenCv;
  throw UsageError(fmt::format("video: --encoder is '{}'; allowed are auto, ffmpeg and opencv",
                               printable(name)));
}

/// A GIF of the usual size and frame rate has megabytes for each second.
void make_small(render::VideoOptions& video) {
  constexpr int kWidth = 640;
  constexpr double kFps = 15.0;
  video.fps = std::min(video.fps, kFps);
  if (video.width <= kWidth) return;
  const double scale = static_cast<double>(kWidth) / video.width;
  video.height = std::max(160, 2 * static_cast<int>(std::lround(0.5 * scale * video.height)));
  video.width = kWidth;
}

render::VideoOptions changed_by(const VideoCommandOptions& options, render::VideoOptions video) {
  if (video.path.extension() == ".gif") make_small(video);
  apply(options.look, video);
  video.fps = options.fps.value_or(video.fps);
  video.slow = options.slow.value_or(video.slow);
  video.from = options.from.value_or(video.from);
  if (options.to) video.to = options.to;
  video.encoder = parse_encoder(options.encoder);
  video.jobs = static_cast<std::size_t>(options.jobs.value_or(0));
  return video;
}

}  // namespace

int video(const VideoCommandOptions& options, const Manners& manners) {
  const std::string& file = options.scene.files.front();
  const Scene any_scene = load_scene(file, options.scene);
  const auto* scene = std::get_if<WorldScene>(&any_scene);
  if (scene == nullptr) {
    throw UsageError(fmt::format("video: {} is a series, which has no video", printable(file)));
  }
  fs::path path = options.output;
  if (path.empty()) {
    const fs::path folder = default_folder(scene->name, file);
    make_folder(folder);
    path = folder / "video.mp4";
  }
  if (!options.poster.empty()) render::check_output_path(options.poster, {"png"});
  const std::vector<Contender> contenders =
      options.compare ? filters_side_by_side(*scene, "video") : std::vector{own_tracker(*scene)};
  render::VideoOptions wanted =
      changed_by(options, film::video_options(*scene, make_world(*scene).objects(), path));
  render::check_request(wanted);
  VideoPlace place(path);
  wanted.path = place.scratch_path();
  film::Film film(
      *scene, [scene] { return make_world(*scene); }, wanted, contenders,
      {.first = 0, .count = contenders.size()}, stop_if_interrupted);
  RunWatch watch(film.frame_times().size(), manners.quiet);
  try {
    ghtrack::run(*scene, film.truth(), contenders, {&watch, &film}, film.frame_times());
  } catch (Interrupted& interrupted) {
    keep_partial(film, place, interrupted);
    throw;
  }
  if (!options.poster.empty()) film.writer().write_poster(options.poster);
  film.writer().finish();
  place.commit();
  if (!manners.quiet) tell("{}: {}", scene->name, path.string());
  return 0;
}

}  // namespace ghtrack::cli

// `ghtrack video`: the annotated video alone.

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/cli/video_frames.hpp"
#include "tools/cli/video_look.hpp"
#include "tools/cli/video_place.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/pipeline/simulation.hpp"
#include "tools/record/result_folder.hpp"
#include "tools/render/output_path.hpp"

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

render::VideoOptions changed_by(const VideoCommandOptions& options, render::VideoOptions video) {
  apply(options.look, video);
  video.fps = options.fps.value_or(video.fps);
  video.slow = options.slow.value_or(video.slow);
  video.from = options.from.value_or(video.from);
  if (options.to) video.to = options.to;
  video.encoder = parse_encoder(options.encoder);
  return video;
}

/// The filters that the scene names under `compare`.
std::vector<film::Contender> contenders_of(const WorldScene& scene) {
  constexpr std::size_t kFewest = 2;
  constexpr std::size_t kMost = 6;
  const std::size_t count = scene.compare.filters.size();
  if (count < kFewest || count > kMost) {
    throw UsageError(
        fmt::format("video: --compare needs {} to {} filters under `compare: {{filters: …}}` of "
                    "the scene, which has {}",
                    kFewest, kMost, count));
  }
  return film::contenders_of(scene);
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
  std::vector<film::Contender> contenders;
  if (options.compare) contenders = contenders_of(*scene);
  World world = make_world(*scene);
  render::VideoOptions wanted = changed_by(options, film::video_options(*scene, world, path));
  render::check_request(wanted);
  VideoPlace place(path);
  wanted.path = place.scratch_path();
  VideoFrames frames(*scene, world, wanted, std::move(contenders), manners.quiet);
  film_run(*scene, world, frames, place);
  if (!options.poster.empty()) frames.writer().write_poster(options.poster);
  frames.writer().finish();
  place.commit();
  if (!manners.quiet) tell("{}: {}", scene->name, path.string());
  return 0;
}

}  // namespace ghtrack::cli

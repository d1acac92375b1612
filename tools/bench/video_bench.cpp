// A whole video beside the encoding of its frames, which wait in memory: what simulating, tracking
// and drawing add. Usage: ghtrack_bench_video [SECONDS of scenes/three_regimes.yaml]

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <variant>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "tools/film/frame_maker.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/run/run.hpp"
#include "tools/render/encoder.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/video_file.hpp"

namespace ghtrack {
namespace {

constexpr int kRounds = 5;

/// Runs the scene and hands out each frame.
void film_scene(const WorldScene& scene, const render::VideoOptions& options,
                const film::FrameMaker::OnFrame& on_frame) {
  SimulatedTruth truth([&] { return make_world(scene); });
  film::FrameMaker maker(scene, truth.objects(), {}, on_frame);
  run(scene, truth, std::vector{own_tracker(scene)}, {&maker},
      render::frame_times(options, scene.duration));
}

render::SceneDrawing drawing_of(const WorldScene& scene, const World& world) {
  SimulatedTruth truth([&] { return make_world(scene); });
  return film::drawing_of(scene, world, truth, {}, [] {});
}

std::vector<cv::Mat> frames_in_memory(const WorldScene& scene,
                                      const render::VideoOptions& options) {
  World world = make_world(scene);
  render::Picture picture(options, drawing_of(scene, world));
  std::vector<cv::Mat> frames;
  film_scene(scene, options,
             [&](const render::VideoFrame& frame) { picture.draw(frame, frames.emplace_back()); });
  return frames;
}

void encode(const std::vector<cv::Mat>& frames, const render::VideoOptions& options) {
  const auto encoder = render::make_encoder(options, options.path);
  for (const cv::Mat& frame : frames) encoder->add(frame);
  encoder->close();
}

void make_video(const WorldScene& scene, const render::VideoOptions& options) {
  World world = make_world(scene);
  const auto video = render::open_video_file(options, drawing_of(scene, world));
  film_scene(scene, options,
             [&](const render::VideoFrame& frame) { video->add_frame(frame); });
  video->finish();
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

int bench(const std::string& seconds) {
  const std::string file = std::string(GHTRACK_SOURCE_DIR) + "/scenes/three_regimes.yaml";
  const std::vector<std::string> changes{"duration=" + seconds};
  const auto scene = std::get<WorldScene>(read_scene(file, changes));
  const World world = make_world(scene);
  const auto folder = std::filesystem::temp_directory_path();
  const auto options = film::video_options(scene, world.objects(), folder / "ghtrack_bench_video.mp4");

  const std::vector<cv::Mat> frames = frames_in_memory(scene, options);
  double encoding = 1e9;
  double whole = 1e9;
  for (int round = 0; round < kRounds; ++round) {  // in turns: a busy machine slows both alike
    encoding = std::min(encoding, seconds_of([&] { encode(frames, options); }));
    whole = std::min(whole, seconds_of([&] { make_video(scene, options); }));
  }
  std::filesystem::remove(options.path);
  fmt::print("{} frames of {}x{}: encoding {:.2f} s, whole video {:.2f} s, ratio {:.2f}\n",
             frames.size(), options.width, options.height, encoding, whole, whole / encoding);
  return 0;
}

}  // namespace
}  // namespace ghtrack

int main(int argc, char** argv) { return ghtrack::bench(argc > 1 ? argv[1] : "20"); }

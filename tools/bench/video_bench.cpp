// A whole video beside the encoding of its frames, which wait in memory: what simulating, tracking
// and drawing add. Usage: ghtrack_bench_video [SECONDS of scenes/three_regimes.yaml]

#include <fmt/format.h>
#include <sys/resource.h>

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
#include "tools/render/encoder.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/video_file.hpp"
#include "tools/run/run.hpp"

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
  film_scene(scene, options, [&](const render::VideoFrame& frame) { video->add_frame(frame); });
  video->finish();
}

/// What work takes [s]: the least of several rounds.
struct Cost {
  double wall = 1e9;
  double cpu = 1e9;  // of all threads and processes
};

double cpu_seconds() {
  double sum = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    ::getrusage(who, &used);
    for (const timeval& part : {used.ru_utime, used.ru_stime}) {
      sum += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    }
  }
  return sum;
}

void measure(const std::function<void()>& work, Cost& least) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  work();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  least.wall = std::min(least.wall, wall.count());
  least.cpu = std::min(least.cpu, cpu_seconds() - cpu);
}

int bench(const std::string& seconds) {
  const std::string file = std::string(GHTRACK_SOURCE_DIR) + "/scenes/three_regimes.yaml";
  const std::vector<std::string> changes{"duration=" + seconds};
  const auto scene = std::get<WorldScene>(read_scene(file, changes));
  const World world = make_world(scene);
  const auto folder = std::filesystem::temp_directory_path();
  auto options = film::video_options(scene, world.objects(), folder / "ghtrack_bench_video.mp4");

  const std::vector<cv::Mat> frames = frames_in_memory(scene, options);
  Cost encoding;
  Cost whole[2];
  for (int round = 0; round < kRounds; ++round) {  // in turns: a busy machine slows all alike
    measure([&] { encode(frames, options); }, encoding);
    for (std::size_t jobs : {1, 2}) {
      options.jobs = jobs;
      measure([&] { make_video(scene, options); }, whole[jobs - 1]);
    }
  }
  std::filesystem::remove(options.path);
  fmt::print("{} frames of {}x{}: encoding {:.2f} s, whole video {:.2f} s, ratio {:.2f}\n",
             frames.size(), options.width, options.height, encoding.wall, whole[0].wall,
             whole[0].wall / encoding.wall);
  fmt::print("of processors: encoding {:.2f} s, whole video {:.2f} s, ratio {:.2f}\n", encoding.cpu,
             whole[0].cpu, whole[0].cpu / encoding.cpu);
  fmt::print("two at a time: {:.2f} s, {:.2f} times as fast, {:.2f} s of processors\n",
             whole[1].wall, whole[0].wall / whole[1].wall, whole[1].cpu);
  return 0;
}

}  // namespace
}  // namespace ghtrack

int main(int argc, char** argv) { return ghtrack::bench(argc > 1 ? argv[1] : "20"); }

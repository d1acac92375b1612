#include "tools/render/video.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "tools/render/module.hpp"
#include "tools/render/output_path.hpp"

namespace ghtrack::render {

namespace {

constexpr int kSmallestSide = 160;
constexpr int kLargestSide = 7680;
constexpr double kMostFrames = 1e6;

std::string number(double value) {
  std::string text = std::to_string(value);
  while (text.size() > 1 && text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

void check_range(const char* name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw RequestError(std::string(name) + " is " + number(value) + "; allowed: " + number(least) +
                       " to " + number(most));
}

void check_side(const char* name, int pixels) {
  check_range(name, pixels, kSmallestSide, kLargestSide);
  if (pixels % 2 != 0)
    throw RequestError(std::string(name) + " is " + std::to_string(pixels) +
                       " pixels; it must be even");
}

}  // namespace

std::size_t frame_count(const VideoOptions& options, double duration) {
  check_range("fps", options.fps, 1.0, 240.0);
  check_range("slow", options.slow, 0.01, 1000.0);
  const double end = std::min(options.to.value_or(duration), duration);
  if (!(options.from >= 0.0 && options.from <= end))
    throw RequestError("from is " + number(options.from) + " s, but the video ends at " +
                       number(end) + " s");
  const double frames = std::round((end - options.from) * options.slow * options.fps);
  if (!(frames <= kMostFrames))
    throw RequestError("the video would have " + number(frames) + " frames; at most " +
                       number(kMostFrames) + " are possible: shorten it or lower the frame rate");
  return static_cast<std::size_t>(std::max(1.0, frames));
}

double frame_time(const VideoOptions& options, std::size_t index) {
  return options.from + static_cast<double>(index) / (options.fps * options.slow);
}

std::vector<double> frame_times(const VideoOptions& options, double duration) {
  std::vector<double> times(frame_count(options, duration));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = frame_time(options, i);
  return times;
}

std::vector<double> times_before(const VideoOptions& options) {
  VideoOptions whole = options;
  whole.from = 0.0;
  std::vector<double> times;
  const double step = 1.0 / (options.fps * options.slow);
  for (std::size_t i = 0; frame_time(whole, i) < options.from - 1e-6 * step; ++i) {
    if (static_cast<double>(i) > kMostFrames) break;
    times.push_back(frame_time(whole, i));
  }
  return times;
}

void check_request(const VideoOptions& options) {
  check_side("width", options.width);
  check_side("height", options.height);
  check_range("fps", options.fps, 1.0, 240.0);
  check_range("slow", options.slow, 0.01, 1000.0);
  for (const Shot& shot : options.shots) check_range("a shot's width", shot.width, 0.1, 1e5);
  for (const CloseUp& close_up : options.close_ups) {
    check_range("a close-up's width", close_up.width, 1e-3, 1e5);
  }
  if (is_picture_folder(options.path))
    check_picture_folder(options.path);
  else
    check_output_path(options.path, {"mp4", "webm", "avi", "mkv", "gif", "png"});
}

VideoWriter::VideoWriter(const VideoOptions& options, const SceneDrawing& scene) {
  check_request(options);
  sink_ = render_module().open_video(options, scene);
}

VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::add_frame(const VideoFrame& frame) { sink_->add_frame(frame); }

void VideoWriter::remember(const VideoFrame& frame) { sink_->remember(frame); }

void VideoWriter::write_poster(const std::filesystem::path& path) {
  check_output_path(path, {"png"});
  sink_->write_poster(path);
}

void VideoWriter::finish() { sink_->finish(); }

void VideoWriter::keep_partial() { sink_->keep_partial(); }

}  // namespace ghtrack::render

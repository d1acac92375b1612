#include "tools/cli/video_frames.hpp"

#include <algorithm>
#include <numbers>
#include <utility>
#include <variant>

#include "sensors/view_geometry.hpp"
#include "sim/regimes/rail_line.hpp"
#include "sim/regimes/train.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/pipeline/simulation.hpp"

namespace ghtrack::cli {
namespace {

std::vector<double> frame_times(const render::VideoOptions& options, double duration) {
  std::vector<double> times(render::frame_count(options, duration));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = render::frame_time(options, i);
  return times;
}

/// The line of a train's rails, fine enough to look smooth.
std::vector<Vec2> rails_of(const Train& train) {
  constexpr double kSpacing = 5.0;  // [m]
  const RailLine line(train.track, train.position, train.heading_deg * std::numbers::pi / 180.0);
  const auto pieces = static_cast<int>(std::clamp(line.length() / kSpacing, 1.0, 2000.0));
  std::vector<Vec2> rails;
  for (int i = 0; i <= pieces; ++i) {
    rails.push_back(line.at(line.length() * i / pieces).position);
  }
  return rails;
}

render::SceneDrawing drawing_of(const WorldScene& scene, const World& world,
                                const std::vector<Contender>& contenders) {
  render::SceneDrawing drawing;
  for (const Contender& contender : contenders) drawing.panels.push_back(contender.drawing());
  drawing.title = scene.name;
  drawing.seed = scene.seed;
  drawing.duration = scene.duration;
  for (const Target& target : scene.targets) {
    if (const auto* train = std::get_if<Train>(&target.motion)) {
      drawing.rails.push_back(rails_of(*train));
    }
  }
  drawing.objects = world.objects();
  if (scene.video && scene.video->region.size() == 2) {
    drawing.world = render::Rectangle{scene.video->region[0], scene.video->region[1]};
  } else {
    drawing.world = render::bounding_rectangle(places_visited(scene, stop_if_interrupted));
  }
  drawing.ground = scene.environment.ground;
  drawing.walls = scene.environment.walls;
  drawing.boxes = scene.environment.boxes;
  for (const SensorConfig& sensor : scene.sensors) {
    drawing.sensors.push_back(
        {.name = sensor.name, .rate = sensor.rate, .field_of_view = outline_of(sensor.view())});
  }
  return drawing;
}

std::optional<ObjectId> object_named(const World& world, const std::optional<std::string>& name) {
  for (const ObjectInfo& object : world.objects()) {
    if (name && object.name == *name) return object.id;
  }
  return std::nullopt;
}

}  // namespace

render::VideoOptions video_options(const WorldScene& scene, const World& world,
                                   const std::filesystem::path& path) {
  const VideoConfig config = scene.video.value_or(VideoConfig{});
  render::VideoOptions options;
  options.path = path;
  options.width = config.size[0];
  options.height = config.size[1];
  options.fps = config.fps;
  options.slow = config.slow;
  options.from = config.from;
  options.to = config.to;
  options.layers = render::Layers(config.show);
  options.follow = object_named(world, config.follow);
  options.follow_width = config.follow_width;
  return options;
}

VideoFrames::VideoFrames(const WorldScene& scene, const World& world,
                         const render::VideoOptions& options, std::vector<Contender> contenders,
                         bool quiet)
    : VideoFrames(world, options, contenders, drawing_of(scene, world, contenders), scene.duration,
                  quiet) {}

VideoFrames::VideoFrames(const World& world, const render::VideoOptions& options,
                         std::vector<Contender> contenders, const render::SceneDrawing& drawing,
                         double duration, bool quiet)
    : world_(world),
      contenders_(std::move(contenders)),
      writer_(options, drawing),
      times_(frame_times(options, duration)),
      progress_("video", "frames", times_.size(), quiet) {
  frame_.panels.resize(1);
  if (!options.layers.shows(render::Layer::kWind)) return;
  for (const Vec2& position : render::wind_points(options, drawing)) {
    frame_.wind.push_back({position, Vec2::Zero()});
  }
}

void VideoFrames::add_scan(const StepRecord& record) {
  latest_[record.observation.scan.sensor] = record.observation;
  if (contenders_.empty()) frame_.panels.front().tracks = record.tracks;
  for (Contender& contender : contenders_) {
    contender.add(record.observation);
    contender.score(record.truth);
  }
  ++frame_.scans;
}

void VideoFrames::add_late_scan(const Observation& observation) {
  latest_[observation.scan.sensor] = observation;
  for (Contender& contender : contenders_) contender.add(observation);
  ++frame_.scans;
}

void VideoFrames::add_frame(const TruthSnapshot& truth) {
  frame_.time = truth.time;
  frame_.truth = truth;
  for (render::WindSample& sample : frame_.wind) {
    sample.velocity = world_.environment().wind().at(sample.position, truth.time);
  }
  if (!contenders_.empty()) {
    frame_.panels.clear();
    for (const Contender& contender : contenders_) frame_.panels.push_back(contender.frame());
  }
  frame_.observations.clear();
  for (const auto& [sensor, observation] : latest_) frame_.observations.push_back(observation);
  writer_.add_frame(frame_);
  progress_.advance();
}

}  // namespace ghtrack::cli

#include "tools/cli/video_frames.hpp"

#include "tools/pipeline/simulation.hpp"

namespace ghtrack::cli {
namespace {

std::vector<double> frame_times(const render::VideoOptions& options, double duration) {
  std::vector<double> times(render::frame_count(options, duration));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = render::frame_time(options, i);
  return times;
}

render::SceneDrawing drawing_of(const WorldScene& scene, const World& world) {
  render::SceneDrawing drawing;
  drawing.title = scene.name;
  drawing.seed = scene.seed;
  drawing.objects = world.objects();
  if (scene.video && scene.video->region.size() == 2) {
    drawing.world = render::Rectangle{scene.video->region[0], scene.video->region[1]};
  } else {
    drawing.world = render::bounding_rectangle(places_visited(scene));
  }
  if (scene.environment.ground) drawing.ground_height = scene.environment.ground->height;
  for (const Wall& wall : scene.environment.walls) drawing.walls.push_back({wall.from, wall.to});
  for (const SensorConfig& sensor : scene.sensors) {
    drawing.sensors.push_back(
        {.name = sensor.name, .rate = sensor.rate, .field_of_view = sensor.field_of_view});
  }
  return drawing;
}

std::optional<ObjectId> object_named(const World& world, const std::optional<std::string>& name) {
  for (const ObjectInfo& object : world.objects()) {
    if (name && object.name == *name) return object.id;
  }
  return std::nullopt;
}

/// The scene and the renderer name the same layers.
render::Layers layers_of(const VideoConfig& config) {
  render::Layers layers;
  for (const VideoLayer wanted : config.show) {
    for (const auto& [name, layer] : enum_names(wanted)) {
      if (layer == wanted) layers.show(*render::layer_named(name));
    }
  }
  return layers;
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
  options.layers = layers_of(config);
  options.follow = object_named(world, config.follow);
  options.follow_width = config.follow_width;
  return options;
}

VideoFrames::VideoFrames(const WorldScene& scene, const World& world,
                         const render::VideoOptions& options, bool quiet)
    : writer_(options, drawing_of(scene, world)),
      times_(frame_times(options, scene.duration)),
      progress_("video", "frames", times_.size(), quiet) {
  frame_.panels.resize(1);
}

void VideoFrames::add_scan(const StepRecord& record) {
  latest_[record.observation.scan.sensor] = record.observation;
  frame_.panels.front().tracks = record.tracks;
  ++frame_.scans;
}

void VideoFrames::add_frame(const TruthSnapshot& truth) {
  frame_.time = truth.time;
  frame_.truth = truth;
  frame_.observations.clear();
  for (const auto& [sensor, observation] : latest_) frame_.observations.push_back(observation);
  writer_.add_frame(frame_);
  progress_.advance();
}

}  // namespace ghtrack::cli

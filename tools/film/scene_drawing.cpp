#include "tools/film/scene_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "sensors/sensor.hpp"
#include "sensors/view_geometry.hpp"
#include "sim/regimes/rail_line.hpp"
#include "sim/regimes/train.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/render/view.hpp"

namespace ghtrack::film {
namespace {

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

/// The strongest wind at a few places and times; arrows need no more.
double strongest_wind(const Wind& wind, const render::Rectangle& area, double duration) {
  constexpr int kPlaces = 4;  // along each axis
  constexpr int kInstants = 8;
  double strongest = 0.0;
  for (int instant = 0; instant < kInstants; ++instant)
    for (int column = 0; column < kPlaces; ++column)
      for (int row = 0; row < kPlaces; ++row) {
        const Vec2 share((column + 0.5) / kPlaces, (row + 0.5) / kPlaces);
        const Vec2 place = area.min + share.cwiseProduct(area.max - area.min);
        strongest = std::max(strongest, wind.at(place, duration * instant / kInstants).norm());
      }
  return strongest;
}

/// A radar stands where it measures from; a sensor without a place says so by its default.
std::optional<Vec2> site_of(const SensorConfig& sensor) {
  const bool has_place = std::holds_alternative<Radar>(sensor.model) || sensor.half_range ||
                         sensor.site != Vec2::Zero();
  return has_place ? std::optional(sensor.site) : std::nullopt;
}

std::optional<ObjectId> object_named(const std::vector<ObjectInfo>& objects,
                                     const std::optional<std::string>& name) {
  for (const ObjectInfo& object : objects) {
    if (object.name == name) return object.id;
  }
  return std::nullopt;
}

/// How far back a picture looks: far enough that a path is seen in a long scene [s].
double usual_trail(double duration, double slow) {
  constexpr double kLeast = 3.0;  // [s] of the video
  constexpr double kShare = 0.125;
  return std::max(kLeast, kShare * duration * std::min(1.0, slow));
}

}  // namespace

render::VideoOptions video_options(const WorldScene& scene, const std::vector<ObjectInfo>& objects,
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
  options.trail = config.trail.value_or(usual_trail(scene.duration, config.slow));
  options.theme = config.theme;
  options.text = config.text;
  if (const auto target = object_named(objects, config.follow)) {
    options.shots = {{.at = 0.0, .target = target, .center = {}, .width = config.follow_width}};
  }
  for (const VideoShot& shot : config.shots) {
    options.shots.push_back({shot.at, object_named(objects, shot.target), shot.center, shot.width});
  }
  options.glide = config.glide;
  if (config.close_up) {
    if (const auto target = object_named(objects, config.close_up->target)) {
      options.close_ups = {{*target, config.close_up->width, config.close_up->corner}};
    }
  }
  return options;
}

namespace {

/// Notes where everything goes, for close-ups that hide nobody, and makes them wide enough for some
/// steps from detection to detection, as far as that is less than `widest` [m].
void fit_to_motion(TruthSource& truth, double duration, double period, double widest,
                   const std::function<void()>& on_step, render::SceneDrawing& drawing,
                   std::vector<render::CloseUp>& close_ups) {
  constexpr double kWidthInSteps = 4.0;
  std::vector<double> speeds(drawing.objects.size(), 0.0);  // summed over the instants
  std::vector<int> instants(drawing.objects.size(), 0);
  truth.restart();
  for (const double time : extent_instants(duration)) {
    on_step();
    const std::shared_ptr<const TruthSnapshot> snapshot = truth.at(time);
    for (const BodyPose& body : snapshot->bodies) drawing.places.push_back(body.position);
    for (const TruthState& object : snapshot->objects) {
      if (!object.velocity.allFinite()) continue;
      speeds[static_cast<std::size_t>(object.id)] += object.velocity.norm();
      ++instants[static_cast<std::size_t>(object.id)];
    }
  }
  for (render::CloseUp& close_up : close_ups) {
    const auto object = static_cast<std::size_t>(close_up.target);
    const double step = period * speeds[object] / std::max(1, instants[object]);
    close_up.width = std::max(close_up.width, std::min(kWidthInSteps * step, widest));
  }
}

}  // namespace

void magnify_small_errors(const WorldScene& scene, TruthSource& truth,
                          const std::function<void()>& on_step, render::SceneDrawing& drawing,
                          render::VideoOptions& options) {
  constexpr double kLeastVisible = 1.0 / 320.0;  // of the picture, for 1 sigma of a detection
  constexpr double kWidthInSigmas = 40.0;
  constexpr double kWidthInLengths = 2.5;
  constexpr std::size_t kMost = 2;
  constexpr std::size_t kCrowd = 20;  // of which two from near by show nothing
  const bool says_where = !options.shots.empty() || !options.close_ups.empty();
  if (says_where || drawing.objects.size() > kCrowd) return;
  const render::Rectangle world = render::world_of(drawing);
  const Vec2 size = world.max - world.min;
  const double aspect = static_cast<double>(options.width) / options.height;
  const double whole = std::max(size.x(), aspect * size.y());  // [m] across the picture
  const RunMetricsOptions scoring = scoring_for(traits_of(scene.sensors));
  if (!(scoring.sigma < kLeastVisible * whole)) return;
  const double widest = 0.25 * size.x();
  for (const ObjectInfo& object : drawing.objects) {
    if (options.close_ups.size() == kMost) break;
    const double width =
        std::max(kWidthInSigmas * scoring.sigma, kWidthInLengths * object.outline.length);
    if (width > widest) continue;  // would show no more than the whole does
    options.close_ups.push_back({.target = object.id, .width = width, .corner = std::nullopt});
  }
  if (options.close_ups.empty()) return;
  fit_to_motion(truth, scene.duration, scoring.period, widest, on_step, drawing, options.close_ups);
}

render::SceneDrawing drawing_of(const WorldScene& scene, const World& world, TruthSource& truth,
                                std::vector<render::PanelDrawing> panels,
                                const std::function<void()>& on_step) {
  render::SceneDrawing drawing;
  drawing.panels = std::move(panels);
  drawing.title = scene.name;
  drawing.seed = scene.seed;
  drawing.duration = scene.duration;
  for (const Target& target : scene.targets) {
    if (const auto* train = std::get_if<Train>(&target.motion)) {
      drawing.rails.push_back(rails_of(*train));
    }
  }
  drawing.objects = world.objects();
  if (!needs_extent(scene)) {
    drawing.world = render::Rectangle{scene.video->region[0], scene.video->region[1]};
  } else {
    drawing.world = render::bounding_rectangle(places_visited(truth, scene.duration, on_step));
  }
  drawing.ground = scene.environment.ground;
  drawing.walls = scene.environment.walls;
  drawing.boxes = scene.environment.boxes;
  for (const SensorConfig& sensor : scene.sensors) {
    drawing.sensors.push_back({.name = sensor.name,
                               .rate = sensor.rate,
                               .site = site_of(sensor),
                               .field_of_view = outline_of(sensor.view()),
                               .has_clutter = sensor.clutter > 0.0,
                               .has_ellipses = std::holds_alternative<Radar>(sensor.model)});
  }
  const Wind& wind = world.environment().wind();
  drawing.wind = [&wind](const Vec2& place, double time) { return wind.at(place, time); };
  drawing.strongest_wind = strongest_wind(wind, render::world_of(drawing), scene.duration);
  return drawing;
}

bool needs_extent(const WorldScene& scene) {
  return !scene.video || scene.video->region.size() != 2;
}

render::PanelDrawing panel_of(const Contender& contender) {
  const Filter& filter = contender.tracker.design().filter_for(TrackerConfig::kDefaultFilter, 0);
  return {.name = contender.name, .gains = title(filter)};
}

}  // namespace ghtrack::film

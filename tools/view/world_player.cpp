#include "tools/view/world_player.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <variant>

#include "sensors/sensor.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/run/run.hpp"
#include "tools/run/schedule.hpp"

namespace ghtrack::view {
namespace {

/// The scene with sensors so many times as noisy. Their dice fall the same way.
WorldScene with_noise(WorldScene scene, double times) {
  struct Scale {
    double times;
    void operator()(PositionSensor& sensor) const {
      sensor.noise *= times;
      if (sensor.noise_y) *sensor.noise_y *= times;
    }
    void operator()(Radar& radar) const {
      radar.sigma_range *= times;
      radar.sigma_bearing_deg *= times;
    }
    void operator()(Camera& camera) const { camera.noise_px *= times; }
  };
  for (SensorConfig& sensor : scene.sensors) std::visit(Scale{times}, sensor.model);
  return scene;
}

/// Gives every filter of that kind this 1-sigma speed of a target seen once.
void set_guess(FilterConfig& filter, double speed) {
  if (auto* gh = std::get_if<GhConfig>(&filter)) gh->initial_speed = speed;
  if (auto* ghk = std::get_if<GhkConfig>(&filter)) ghk->initial_speed = speed;
}

}  // namespace

WorldPlayer::WorldPlayer(const WorldScene& scene)
    : scene_(scene),
      sensed_(scene),
      world_(make_world(scene_)),
      options_(film::video_options(scene_, world_.objects(), {})),
      knobs_{{"g", 0.001, 1.99, 0.4, true},
             {"h", 0.0001, 2.0, 0.1, true},
             {"k", 0.0, 0.5, 0.0, true},
             {"initial speed [m/s]", 1.0, 100.0, 30.0, true},
             {"noise, times", 0.05, 5.0, 1.0}} {
  frame_times_ = render::frame_times(options_, scene_.duration);
  SimulatedTruth simulated([this] { return make_world(scene_); });
  drawing_ = film::drawing_of(scene_, world_, simulated, {}, [] {});
  const std::vector<double> scans = scan_instants(scene_);
  std::vector<double> instants;
  std::set_union(scans.begin(), scans.end(), frame_times_.begin(), frame_times_.end(),
                 std::back_inserter(instants));
  truth_ = repeatable_truth([this] { return make_world(scene_); }, instants, [] {});
  choose_tracker();
  filter();
}

double WorldPlayer::seconds_per_frame() const { return 1.0 / options_.fps; }

TrackerConfig WorldPlayer::wanted_tracker() const {
  TrackerConfig config = scene_.tracker;
  if (is_turned_[kG] || is_turned_[kH] || is_turned_[kK]) {
    FilterConfig filter = GhConfig{.design = gain_design::Manual<1>{value(kG), value(kH)}};
    if (value(kK) > 0.0)
      filter = GhkConfig{.design = gain_design::Manual<2>{value(kG), value(kH), value(kK)}};
    config.filters = {{std::string(TrackerConfig::kDefaultFilter), filter}};
  }
  if (is_turned_[kGuess])
    for (auto& [name, filter] : config.filters) set_guess(filter, value(kGuess));
  return config;
}

void WorldPlayer::turn(std::size_t knob, double value) {
  knobs_.at(knob).value = value;
  is_turned_.at(knob) = true;
  if (knob == kNoise) sensed_ = with_noise(scene_, value);
  choose_tracker();
  filter();
}

void WorldPlayer::toggle(render::Layer layer) {
  if (options_.layers.shows(layer))
    options_.layers.hide(layer);
  else
    options_.layers.show(layer);
  start_over();
}

/// Takes the tracker that the knobs ask for. If its gains are unstable the title says so, and the
/// one before goes on.
void WorldPlayer::choose_tracker() {
  const bool is_own = !is_turned_[kG] && !is_turned_[kH] && !is_turned_[kK];
  try {
    tracker_ = {{"", SceneTracker(wanted_tracker(), traits_of(sensed_.sensors))}};
    drawing_.title =
        scene_.name + ": " + (is_own ? "its own filters" : film::panel_of(tracker_.front()).gains);
  } catch (const std::invalid_argument& error) {
    drawing_.title = scene_.name + ": " + error.what();
  }
}

/// Runs the sensors and the tracker over the whole truth.
void WorldPlayer::filter() {
  shown_.clear();
  film::FrameMaker maker(sensed_, {},
                         [this](const render::VideoFrame& frame) { shown_.push_back(frame); });
  truth_->restart();
  run(sensed_, *truth_, tracker_, {&maker}, frame_times_);
  start_over();
}

/// Draws from the start to the present frame.
void WorldPlayer::start_over() {
  picture_ = std::make_unique<render::Picture>(options_, drawing_);
  next_frame_ = 0;
  seek(frame_);
}

void WorldPlayer::seek(std::size_t frame) {
  frame_ = std::min(frame, frames() - 1);
  if (next_frame_ > frame_) return start_over();
  for (; next_frame_ < frame_; ++next_frame_) picture_->remember(shown_[next_frame_]);
  picture_->draw(shown_[next_frame_++], image_);
}

}  // namespace ghtrack::view

#include "tools/view/world_player.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "sensors/sensor.hpp"
#include "tools/film/contender.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/pipeline/simulation.hpp"

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
      options_(film::video_options(scene_, world_, {})),
      drawing_(film::drawing_of(scene_, world_, {}, [] {})),
      knobs_{{"g", 0.001, 1.99, 0.4, true},
             {"h", 0.0001, 2.0, 0.1, true},
             {"k", 0.0, 0.5, 0.0, true},
             {"initial speed [m/s]", 1.0, 100.0, 30.0, true},
             {"noise, times", 0.05, 5.0, 1.0}} {
  recording_ = record(sensed_, render::frame_times(options_, scene_.duration));
  choose_tracker();
  start_over();
}

double WorldPlayer::seconds_per_frame() const { return 1.0 / options_.fps; }

TrackerConfig WorldPlayer::wanted_tracker() const {
  TrackerConfig config = scene_.tracker;
  if (is_turned_[kG] || is_turned_[kH] || is_turned_[kK]) {
    FilterConfig filter = GhConfig{.design = gain_design::Manual<1>{value(kG), value(kH)}};
    if (value(kK) > 0.0)
      filter = GhkConfig{.design = gain_design::Manual<2>{value(kG), value(kH), value(kK)}};
    config = film::with_filter(std::move(config), filter);
  }
  if (is_turned_[kGuess])
    for (auto& [name, filter] : config.filters) set_guess(filter, value(kGuess));
  return config;
}

void WorldPlayer::turn(std::size_t knob, double value) {
  knobs_.at(knob).value = value;
  is_turned_.at(knob) = true;
  if (knob == kNoise) {
    sensed_ = with_noise(scene_, value);
    recording_ = record(sensed_, render::frame_times(options_, scene_.duration));
  }
  choose_tracker();
  start_over();
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
    const TrackerConfig wanted = wanted_tracker();
    const film::Contender contender(sensed_, "", wanted);
    tracker_ = wanted;
    drawing_.title = scene_.name + ": " + (is_own ? "its own filters" : contender.drawing().gains);
  } catch (const std::invalid_argument& error) {
    drawing_.title = scene_.name + ": " + error.what();
  }
}

/// Filters from the start to the present frame.
void WorldPlayer::start_over() {
  maker_ = std::make_unique<film::FrameMaker>(sensed_,
                                              std::vector{film::Contender(sensed_, "", tracker_)});
  picture_ = std::make_unique<render::Picture>(options_, drawing_);
  next_arrival_ = 0;
  next_frame_ = 0;
  latest_scan_ = -1.0;
  seek(frame_);
}

void WorldPlayer::seek(std::size_t frame) {
  frame_ = std::min(frame, frames() - 1);
  if (next_frame_ > frame_) return start_over();
  while (next_frame_ <= frame_) {
    const TruthSnapshot& truth = recording_.frames[next_frame_];
    deliver_until(truth.time);
    const render::VideoFrame& shown = maker_->frame(truth);
    if (next_frame_ == frame_)
      picture_->draw(shown, image_);
    else
      picture_->remember(shown);
    ++next_frame_;
  }
}

void WorldPlayer::deliver_until(double time) {
  const std::vector<Arrival>& arrivals = recording_.arrivals;
  for (; next_arrival_ < arrivals.size() && arrivals[next_arrival_].time <= time; ++next_arrival_) {
    const Arrival& arrival = arrivals[next_arrival_];
    const bool is_late = arrival.observation.scan.time < latest_scan_;
    if (is_late)
      maker_->add_late_scan(arrival.observation);
    else
      maker_->add_scan({arrival.truth, arrival.observation, {}});
    latest_scan_ = std::max(latest_scan_, arrival.observation.scan.time);
  }
}

}  // namespace ghtrack::view

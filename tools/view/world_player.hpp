#pragma once

#include <opencv2/core/mat.hpp>

#include <array>
#include <memory>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"
#include "tools/film/frame_maker.hpp"
#include "tools/run/contender.hpp"
#include "tools/run/truth_source.hpp"
#include "tools/render/picture.hpp"
#include "tools/view/knob.hpp"

namespace ghtrack::view {

/// Plays a world scene back and forth, with gains, initial guess and noise to turn. The truth and
/// is recorded once; a turn of a knob looks at it and filters anew.
class WorldPlayer {
 public:
  explicit WorldPlayer(const WorldScene& scene);

  /// g, h, k: one filter for all targets, the scene's own until one of them is turned. The initial
  /// guess: 1-sigma speed of a target seen once. Noise: times that of the scene's sensors.
  const std::vector<Knob>& knobs() const { return knobs_; }
  void turn(std::size_t knob, double value);

  void toggle(render::Layer layer);

  std::size_t frames() const { return shown_.size(); }
  std::size_t frame() const { return frame_; }
  double seconds_per_frame() const;

  /// Goes to a frame; backwards it runs again from the start.
  void seek(std::size_t frame);

  /// The picture of the frame: 8 bit BGR.
  const cv::Mat& image() const { return image_; }

 private:
  enum Setting : std::size_t { kG, kH, kK, kGuess, kNoise, kSettings };
  double value(Setting setting) const { return knobs_[setting].value; }
  TrackerConfig wanted_tracker() const;
  void choose_tracker();
  void filter();
  void start_over();

  WorldScene scene_;
  WorldScene sensed_;  // the same with the noise that was chosen
  World world_;        // stays at its start: only its wind is asked for
  render::VideoOptions options_;
  render::SceneDrawing drawing_;
  std::vector<Knob> knobs_;
  std::array<bool, kSettings> is_turned_{};
  std::vector<double> frame_times_;
  std::unique_ptr<TruthSource> truth_;
  std::vector<Contender> tracker_;         // the one that is shown
  std::vector<render::VideoFrame> shown_;  // of all frame times
  std::unique_ptr<render::Picture> picture_;
  std::size_t next_frame_ = 0;  // that the picture has not taken note of yet
  std::size_t frame_ = 0;
  cv::Mat image_;
};

}  // namespace ghtrack::view

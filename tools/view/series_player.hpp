#pragma once

#include <opencv2/core/mat.hpp>

#include <vector>

#include "scenes/schema/series.hpp"
#include "tools/render/layers.hpp"
#include "tools/view/knob.hpp"

namespace ghtrack::view {

/// Shows the plot of a series scene, with the gains and the initial guess of its last filter and
/// the noise of generated data to turn.
class SeriesPlayer {
 public:
  explicit SeriesPlayer(const SeriesScene& scene);

  const std::vector<Knob>& knobs() const { return knobs_; }
  void turn(std::size_t knob, double value);

  // A plot stands still and has no layers.
  void toggle(render::Layer) {}
  std::size_t frames() const { return 1; }
  std::size_t frame() const { return 0; }
  double seconds_per_frame() const { return 0.05; }
  void seek(std::size_t) {}

  const cv::Mat& image() const { return image_; }

 private:
  enum Setting : std::size_t { kG, kH, kK, kX, kDx, kNoise };
  void show();

  SeriesScene scene_;
  std::vector<Knob> knobs_;
  cv::Mat image_;
};

}  // namespace ghtrack::view

#pragma once

#include <opencv2/core/mat.hpp>

#include <memory>
#include <vector>

#include "tools/render/error_plot.hpp"
#include "tools/render/layout.hpp"
#include "tools/render/track_painter.hpp"

namespace ghtrack::render {

/// Draws the frames of a video, one after the other.
class Picture {
 public:
  Picture(const VideoOptions& options, const SceneDrawing& scene);

  /// @param image receives the picture: 8 bit BGR, of the options' size
  void draw(const VideoFrame& frame, cv::Mat& image);

 private:
  void draw_backdrop_into(cv::Mat& image, const std::vector<View>& views);
  void draw_panel(Canvas& canvas, const View& view, const VideoFrame& frame, std::size_t index);
  void draw_detections(Canvas& canvas, const View& view, const VideoFrame& frame);
  void draw_header(Canvas& canvas, const PanelFrame& panel, std::size_t index);
  void draw_hud(Canvas& canvas, const VideoFrame& frame);

  VideoOptions options_;
  SceneDrawing scene_;
  Style style_;
  Style panel_style_;  // of what shows the world
  Typefaces fonts_;
  Layout layout_;
  std::vector<View> views_;             // one per panel, when nothing is followed
  std::vector<TrackPainter> painters_;  // one per panel
  cv::Mat backdrop_;                    // what does not move, drawn once; empty when following
  double strongest_wind_ = 0.0;         // [m/s] so far
  Legend legend_;
  ErrorPlot errors_;
};

}  // namespace ghtrack::render

#pragma once

#include <opencv2/core/mat.hpp>

#include <optional>
#include <span>
#include <vector>

#include "tools/render/camera.hpp"
#include "tools/render/error_plot.hpp"
#include "tools/render/inset_plots.hpp"
#include "tools/render/layout.hpp"
#include "tools/render/legend.hpp"
#include "tools/render/scene_memory.hpp"
#include "tools/render/stage.hpp"
#include "tools/render/track_labels.hpp"
#include "tools/render/track_memory.hpp"

namespace ghtrack::render {

/// Draws the frames of a video, one after the other.
class Picture {
 public:
  Picture(const VideoOptions& options, const SceneDrawing& scene);
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// @param image receives the picture: 8 bit BGR, of the options' size
  void draw(const VideoFrame& frame, cv::Mat& image);

  /// Takes note of a frame that is not drawn: trails, labels and plots go on from it.
  void remember(const VideoFrame& frame);

  const Layout& layout() const { return layout_; }

 private:
  /// What one tracker's panel needs from frame to frame.
  struct Panel {
    View view;
    TrackMemory memory;
    TrackLabels labels;
  };
  Stage stage_of(const View& view, std::span<const Viewport> covered) const;
  void take_note_of(const VideoFrame& frame);
  void write_labels(Canvas* canvas, const Stage& stage, const VideoFrame& frame, std::size_t panel);
  void draw_still_parts(std::vector<View> views);
  void draw_world(Canvas& canvas, const Stage& stage, const VideoFrame& frame, std::size_t panel);
  void draw_detections(Canvas& canvas, const Stage& stage, const VideoFrame& frame) const;
  /// What a close-up of a panel shows, if its target is there.
  std::optional<View> close_up_view(const TruthSnapshot& truth, std::size_t close_up,
                                    std::size_t panel) const;
  void draw_close_up(Canvas& canvas, const View& view, const VideoFrame& frame,
                     std::size_t close_up, std::size_t panel);

  VideoOptions options_;
  SceneDrawing scene_;
  Style style_;
  Style panel_style_;  // of what shows the world
  Typefaces fonts_;
  Legend legend_;
  Layout layout_;
  Camera camera_;
  SceneMemory past_;
  std::vector<Panel> panels_;
  cv::Mat still_parts_;            // what does not move, as long as the camera does not
  std::vector<View> still_views_;  // for which that was drawn
  ErrorPlot errors_;
  InsetPlots insets_;
};

}  // namespace ghtrack::render

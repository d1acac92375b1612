#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/render/canvas.hpp"
#include "tools/render/label_layout.hpp"
#include "tools/render/legend.hpp"
#include "tools/render/style.hpp"

namespace ghtrack::render {

/// Draws what one tracker says, and remembers what pictures of tracks need: where they were, and
/// which have come and gone.
class TrackPainter {
 public:
  /// @param color of all tracks, when several trackers are compared; else each has its own
  explicit TrackPainter(std::optional<Color> color = std::nullopt) : color_(color) {}

  /// Takes note of a frame; once for each, in the order of time.
  void remember(const VideoFrame& frame, const PanelFrame& panel);

  /// Draws the tracks of the frame that was remembered last.
  void draw(Canvas& canvas, const View& view, const SceneDrawing& scene, const VideoFrame& frame,
            const PanelFrame& panel, Layers layers, const Style& style, const Typefaces& fonts,
            Legend& legend);

 private:
  struct Trace {
    std::deque<std::pair<double, Vec2>> trail;  // [s], [m], oldest first
    TrackEstimate last;
    Vec2 label_position = Vec2::Zero();  // [m] where the label hangs: the position, smoothed
    std::u32string label;
    double label_time = 0.0;           // [s] when the label was written
    std::optional<std::size_t> color;  // index in the palette, from the confirmation on
    bool seen = false;                 // in the latest snapshot
  };
  struct Event {
    Sign sign;  // kLost or kSwitch
    double time = 0.0;
    Vec2 position = Vec2::Zero();
    Color color;
  };

  Color color_of(const TrackEstimate& track) const;
  std::size_t least_used_color() const;
  std::u32string label_text(const TrackEstimate& track) const;
  void draw_gate(Canvas& canvas, const View& view, const TrackEstimate& track,
                 const Style& style) const;
  void draw_residual(Canvas& canvas, const View& view, const TrackEstimate& track,
                     const Style& style) const;
  void draw_estimate(Canvas& canvas, Pixel at, const TrackEstimate& track,
                     const Style& style) const;
  void note_switches(const VideoFrame& frame, const PanelFrame& panel);
  void draw_trails(Canvas& canvas, const View& view, double now, const Style& style) const;
  void draw_events(Canvas& canvas, const View& view, double now, const Style& style,
                   Legend& legend) const;
  void draw_labels(Canvas& canvas, const View& view, const SceneDrawing& scene,
                   const VideoFrame& frame, const Style& style, const Typefaces& fonts);

  std::optional<Color> color_;
  std::map<int, Trace> traces_;  // by track id
  std::map<ObjectId, int> track_of_object_;
  std::vector<Event> events_;
  double snapshot_time_ = -1.0;
  int snapshot_sensor_ = -1;
  std::optional<double> frame_time_;  // [s] of the frame before
  LabelLayout labels_;
};

/// Where a track is at a time not before its estimate: the filter's own prediction [m].
Vec2 predicted_position(const TrackEstimate& track, double ahead);

}  // namespace ghtrack::render

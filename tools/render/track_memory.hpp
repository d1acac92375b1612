#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/render/palette.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::render {

/// Where a track is at a time not before its estimate: the filter's own prediction [m].
Vec2 predicted_position(const TrackEstimate& track, double ahead);

/// Remembers of one tracker what pictures need and a single frame does not tell: where tracks were,
/// which have come and gone, what their labels said.
class TrackMemory {
 public:
  struct Trace {
    std::deque<std::pair<double, Vec2>> trail;  // [s], [m], oldest first
    TrackEstimate last;
    Vec2 label_position = Vec2::Zero();  // [m] where the label hangs: the position, smoothed
    std::u32string label;
    double label_time = 0.0;           // [s] when the label was written
    std::optional<std::size_t> color;  // index in the palette, from the confirmation on
    bool seen = false;                 // in the latest snapshot
  };
  enum class Happening { kLost, kSwitch };
  struct Event {
    Happening what;
    double time = 0.0;
    Vec2 position = Vec2::Zero();
    Color color;
  };

  /// @param color  of all tracks, when several trackers are compared; else each has its own
  /// @param slow   video time per scene time: signs fade in the time of those who watch
  explicit TrackMemory(std::optional<Color> color = std::nullopt, double slow = 1.0)
      : color_(color), slow_(slow) {}

  /// Takes note of a frame; once for each, in the order of time.
  void remember(const VideoFrame& frame, const PanelFrame& panel);

  const std::map<int, Trace>& traces() const { return traces_; }  // by track id
  const std::vector<Event>& events() const { return events_; }
  Color color_of(const TrackEstimate& track) const;

  /// How far something of that time has faded, from 0 to 1.
  double trail_age(double time) const;
  double event_age(double time) const;

 private:
  void take(const TrackSnapshot& tracks);
  void note_switches(const PanelFrame& panel);
  void update_label(Trace& trace, double now, double since) const;
  std::size_t least_used_color() const;
  std::u32string label_text(const TrackEstimate& track) const;

  std::optional<Color> color_;
  double slow_;
  std::map<int, Trace> traces_;
  std::map<ObjectId, int> track_of_object_;
  std::vector<Event> events_;
  double snapshot_time_ = -1.0;
  int snapshot_sensor_ = -1;
  std::optional<double> now_;  // [s] of the latest frame
};

}  // namespace ghtrack::render

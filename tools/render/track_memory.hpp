#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/render/object_colors.hpp"
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
    std::optional<ObjectId> object;    // that it follows, or did last
    bool succeeds = false;             // it took an object over from another track
    bool seen = false;                 // in the latest snapshot
  };
  enum class Happening { kLost, kSwitch };
  struct Event {
    Happening what;
    double time = 0.0;
    Vec2 position = Vec2::Zero();
    Color color;
  };

  /// A trail of a track that has ended.
  struct Past {
    std::deque<std::pair<double, Vec2>> trail;  // [s], [m], oldest first
    Color color;
  };

  /// How tracks are remembered.
  struct Manner {
    std::optional<Color> color;  // of all tracks, when several trackers are compared
    double slow = 1.0;           // video time per scene time: signs fade for those who watch
    double trail = 3.0;          // how far back trails reach [s]; may be infinite
    const Theme* theme = &kDark;
  };

  /// @param objects  by whom labels are named and colours are chosen
  TrackMemory(const Manner& manner, const std::vector<ObjectInfo>& objects)
      : manner_(manner), objects_(objects), colors_(object_colors(objects)) {}

  /// Takes note of a frame; once for each, in the order of time.
  void remember(const VideoFrame& frame, const PanelFrame& panel);

  const std::map<int, Trace>& traces() const { return traces_; }  // by track id
  const std::vector<Past>& past() const { return past_; }         // of tracks that have ended
  const std::vector<Event>& events() const { return events_; }
  Color color_of(const TrackEstimate& track) const;
  /// Whom it follows, with its number if it took over from another track; or else its number.
  std::u32string name_of(const TrackEstimate& track) const;

  /// How far something of that time has faded, from 0 to 1.
  double trail_age(double time) const;
  double event_age(double time) const;

 private:
  void take(const TrackSnapshot& tracks);
  void note_objects(const std::vector<Pairing>& pairings);
  void end_unseen();
  void update_label(Trace& trace, double now, double since) const;
  std::size_t color_for(const Trace& new_trace) const;
  std::u32string label_text(const Trace& trace) const;
  void thin(std::deque<std::pair<double, Vec2>>& trail) const;

  Manner manner_;
  const std::vector<ObjectInfo>& objects_;
  std::map<ObjectId, std::size_t> colors_;  // of the palette, that stand for objects
  std::map<int, Trace> traces_;
  std::map<ObjectId, int> track_of_object_;
  std::vector<Past> past_;
  std::vector<Event> events_;
  double snapshot_time_ = -1.0;
  int snapshot_sensor_ = -1;
  std::optional<double> now_;  // [s] of the latest frame
};

}  // namespace ghtrack::render

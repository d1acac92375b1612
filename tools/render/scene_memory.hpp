#pragma once

#include <deque>
#include <map>
#include <utility>

#include "tools/render/canvas.hpp"
#include "tools/render/stage.hpp"

namespace ghtrack::render {

/// Remembers where objects were and what was detected: beside it the path of an estimate shows how
/// much a filter smooths.
class SceneMemory {
 public:
  /// @param trail  how far back it is shown [s]; may be infinite
  SceneMemory(double trail, double duration);

  /// Takes note of a frame; once for each, in the order of time.
  void remember(const VideoFrame& frame);

  /// The true paths as dashed lines, the detections as small marks, both fading.
  void draw(Canvas& canvas, const Stage& stage) const;

 private:
  struct Mark {
    double time;
    Vec2 position;
    int sensor;
  };
  void remember(const TruthSnapshot& truth);
  double age(double time) const;

  double trail_;
  double step_;  // [s] between points that are kept of a path
  double now_ = 0.0;
  double known_ = 0.0;  // [s] of the latest truth
  std::map<ObjectId, std::deque<std::pair<double, Vec2>>> paths_;
  std::deque<Mark> marks_;
};

/// The mark of a detection, which tells the sensors of a scene apart.
void draw_detection(Canvas& canvas, int sensor, const Pixel& at, double size, const Ink& ink,
                    double thickness);

}  // namespace ghtrack::render

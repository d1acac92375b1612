#pragma once

#include <cstdint>
#include <map>

#include "tools/render/video.hpp"

namespace ghtrack::render {

/// A scene without a simulator, made of formulas: two trains that cross, balls in flight that
/// bounce, balloons in the wind; a camera with noise, misses and clutter; a g-h filter per object
/// and panel.
class SyntheticScene {
 public:
  explicit SyntheticScene(int panels = 1);

  const SceneDrawing& drawing() const { return drawing_; }

  /// The next frame of a video at 30 frames per second; the camera sees one scan per frame.
  VideoFrame next();

 private:
  struct Filter {
    TrackEstimate track;
    int detections = 0;
    int misses = 0;
  };

  TruthSnapshot truth(double time) const;
  double uniform();
  double normal();
  void update(Filter& filter, int panel, std::optional<std::size_t> detection, const Scan& scan);

  SceneDrawing drawing_;
  std::vector<std::map<ObjectId, Filter>> filters_;  // by panel
  std::vector<double> squared_error_;                // by panel
  std::vector<int> errors_;
  std::uint64_t random_ = 88172645463325252u;
  std::size_t scans_ = 0;
  int next_id_ = 1;
};

}  // namespace ghtrack::render

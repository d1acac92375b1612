#pragma once

#include <map>

#include "tools/render/view.hpp"

namespace ghtrack::render {

/// Looks at the world as the shots of a video say, and glides from one to the next.
class Camera {
 public:
  Camera(const VideoOptions& options, const SceneDrawing& scene);

  /// Takes note of where the objects are; once for each frame, in the order of time.
  void remember(const TruthSnapshot& truth);

  /// What a viewport of the picture shows at a time [s].
  View view(double time, const Viewport& viewport) const;

 private:
  /// Where the middle of a picture is, and how wide it is [m].
  struct Pose {
    Vec2 middle;
    double width;
  };
  Pose whole(const Viewport& viewport) const;
  Pose pose(const Shot& shot, const Viewport& viewport) const;

  std::vector<Shot> shots_;
  double glide_;
  Rectangle world_;
  std::map<ObjectId, Vec2> places_;  // where objects were last seen
};

}  // namespace ghtrack::render

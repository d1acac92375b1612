#pragma once

#include <vector>

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"

namespace ghtrack::render {

/// A sign that may occur in a picture.
enum class Sign {
  kTrain,
  kBall,
  kBalloon,
  kDetection,
  kClutter,
  kTrack,
  kTentative,
  kCoasting,
  kTrail,
  kResidual,
  kGate,
  kFan,
  kLost,
  kSwitch,
  kFieldOfView,
  kWind,
};

/// The line at the bottom that explains the signs seen so far. An entry keeps its place: new ones
/// are added at the end.
class Legend {
 public:
  void saw(Sign sign);
  void draw(Canvas& canvas, const Viewport& area, const Style& style, const Typefaces& fonts) const;

 private:
  std::vector<Sign> signs_;
};

}  // namespace ghtrack::render

#pragma once

#include <set>

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"

namespace ghtrack::render {

/// A sign that may occur in a picture.
enum class Sign {
  kTrain,
  kBall,
  kBalloon,
  kDrone,
  kFieldOfView,
  kWind,
  kDetection,
  kClutter,
  kTrail,
  kGate,
  kResidual,
  kFan,
  kTrack,
  kTentative,
  kCoasting,
  kLost,
  kSwitch,
};

/// The line at the bottom that explains the signs seen so far.
class Legend {
 public:
  void saw(Sign sign) { signs_.insert(sign); }
  void draw(Canvas& canvas, const Viewport& area, const Style& style, const Typefaces& fonts) const;

 private:
  std::set<Sign> signs_;
};

}  // namespace ghtrack::render

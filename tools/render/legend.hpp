#pragma once

#include <string>
#include <vector>

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
  kDetection,  // of the first sensor, the second, the third
  kSecondDetection,
  kThirdDetection,
  kError,
  kPast,
  kPath,
  kClutter,
  kTrail,
  kSmoothed,
  kGate,
  kResidual,
  kFan,
  kTrack,
  kTentative,
  kCoasting,
  kLost,
  kSwitch,
  kLeader,
};

/// The lines at the bottom that explain the signs which the pictures of a video may show.
class Legend {
 public:
  /// @param style,fonts  must outlive the legend
  /// @param world_style  of the panels, in whose measure wind is drawn
  Legend(const VideoOptions& options, const SceneDrawing& scene, const Style& style,
         const Style& world_style, const Typefaces& fonts);

  double height() const;  // [px]
  void draw(Canvas& canvas, const Viewport& area) const;

 private:
  /// Signs that share one meaning, such as the shapes of the truth.
  struct Entry {
    std::vector<Sign> signs;
    std::u32string meaning;
    double width;  // [px] of it all
    bool begins_row = false;
  };
  void add_detections(const SceneDrawing& scene);
  void add(std::vector<Sign> signs, std::u32string meaning);
  int fill_rows(double room);
  void break_into_rows(double room);

  const Style& style_;
  const Typefaces& fonts_;
  double wind_arrow_ = 0.0;  // [px] length of the wind's sample
  std::vector<Entry> entries_;
};

}  // namespace ghtrack::render

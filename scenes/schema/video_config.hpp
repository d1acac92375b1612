#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/truth.hpp"

namespace ghtrack {

/// What a picture may show, from back to front.
enum class VideoLayer {
  kGrid,
  kFieldOfView,
  kGround,
  kRails,
  kWind,
  kTruth,
  kNames,
  kTrails,
  kGates,
  kResiduals,
  kDetections,
  kClutter,
  kTracks,
  kFans,
  kLabels,
  kInsets,
  kHud,
  kLegend,
};

constexpr std::array<std::pair<std::string_view, VideoLayer>, 18> enum_names(VideoLayer) {
  return {{{"grid", VideoLayer::kGrid},
           {"field-of-view", VideoLayer::kFieldOfView},
           {"ground", VideoLayer::kGround},
           {"rails", VideoLayer::kRails},
           {"wind", VideoLayer::kWind},
           {"truth", VideoLayer::kTruth},
           {"names", VideoLayer::kNames},
           {"trails", VideoLayer::kTrails},
           {"gates", VideoLayer::kGates},
           {"residuals", VideoLayer::kResiduals},
           {"detections", VideoLayer::kDetections},
           {"clutter", VideoLayer::kClutter},
           {"tracks", VideoLayer::kTracks},
           {"fans", VideoLayer::kFans},
           {"labels", VideoLayer::kLabels},
           {"insets", VideoLayer::kInsets},
           {"hud", VideoLayer::kHud},
           {"legend", VideoLayer::kLegend}}};
}

/// The annotated video of a run.
struct VideoConfig {
  static constexpr std::string_view about = "an annotated video of the run";

  std::array<int, 2> size{1280, 720};  // width and height, both even [px]
  double fps = 30.0;                   // frames per second of video time [Hz]
  double slow = 1.0;                   // video time per scene time
  double from = 0.0;                   // scene time of the first frame [s]
  std::optional<double> to;            // scene time of the last frame; absent: the scene's end [s]
  std::vector<VideoLayer> show{
      VideoLayer::kGrid,      VideoLayer::kFieldOfView, VideoLayer::kGround,  VideoLayer::kRails,
      VideoLayer::kWind,      VideoLayer::kTruth,       VideoLayer::kTrails,  VideoLayer::kGates,
      VideoLayer::kResiduals, VideoLayer::kDetections,  VideoLayer::kClutter, VideoLayer::kTracks,
      VideoLayer::kLabels,    VideoLayer::kHud,         VideoLayer::kLegend};
  std::vector<Vec2> region;  // lower left and upper right corner; empty: all that happens [m]
  std::optional<std::string> follow;    // the target that stays in the middle of the picture
  double follow_width = 40.0;           // of the world across the picture when following [m]

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field(
        "size", &VideoConfig::size,
        {.unit = "px", .meaning = "width and height, both even", .minimum = 64, .maximum = 7680});
    v.field(
        "fps", &VideoConfig::fps,
        {.unit = "Hz", .meaning = "frames per second of video time", .minimum = 1, .maximum = 240});
    v.field("slow", &VideoConfig::slow,
            {.unit = "1",
             .meaning = "video time per scene time; 4 shows everything four times slower",
             .minimum = 1e-3,
             .maximum = 1e3});
    v.field("from", &VideoConfig::from,
            {.unit = "s", .meaning = "scene time of the first frame", .minimum = 0.0});
    v.field("to", &VideoConfig::to,
            {.unit = "s",
             .meaning = "scene time of the last frame; without it the scene's end",
             .above = 0.0});
    v.field("show", &VideoConfig::show, {.meaning = "the layers of the picture"});
    v.field("region", &VideoConfig::region,
            {.unit = "m",
             .meaning = "lower left and upper right corner of what is shown; without it all that "
                        "happens",
             .minimum = -1e7,
             .maximum = 1e7,
             .max_items = 2});
    v.field("follow", &VideoConfig::follow,
            {.meaning = "name of the target that stays in the middle of the picture"});
    v.field("follow_width", &VideoConfig::follow_width,
            {.unit = "m",
             .meaning = "width of the picture in the world when following a target",
             .above = 0.0,
             .maximum = 1e6});
  }

  template <class Report>
  void check(Report&& report) const {
    if (size[0] % 2 != 0) report("size[0]", "the width must be even");
    if (size[1] % 2 != 0) report("size[1]", "the height must be even");
    if (to && *to <= from) report("to", "must be later than 'from'");
    const bool corners = region.size() == 2;
    if (region.size() == 1) report("region", "needs two corners: [[left, bottom], [right, top]]");
    if (corners && !(region[0].array() < region[1].array()).all()) {
      report("region", "the first corner must lie left of and below the second");
    }
  }
};

}  // namespace ghtrack

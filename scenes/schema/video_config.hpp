#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/video_layer.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// The annotated video of a run.
struct VideoConfig {
  static constexpr std::string_view about = "an annotated video of the run";

  std::array<int, 2> size{1280, 720};  // width and height, both even [px]
  double fps = 30.0;                   // frames per second of video time [Hz]
  double slow = 1.0;                   // video time per scene time
  double from = 0.0;                   // scene time of the first frame [s]
  std::optional<double> to;            // scene time of the last frame; absent: the scene's end [s]
  std::vector<VideoLayer> show{kDefaultVideoLayers.begin(), kDefaultVideoLayers.end()};
  std::vector<Vec2> region;  // lower left and upper right corner; empty: all that happens [m]
  std::optional<std::string> follow;  // the target that stays in the middle of the picture
  double follow_width = 40.0;         // of the world across the picture when following [m]

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

#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/video_corner.hpp"
#include "scenes/schema/video_layer.hpp"
#include "scenes/schema/video_theme.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// Where the camera looks from some time on.
struct VideoShot {
  static constexpr std::string_view about =
      "where the camera looks from some time on: at a target, at a place, or at the whole region";

  double at = 0.0;                    // scene time [s]
  std::optional<std::string> target;  // stays in the middle
  std::optional<Vec2> center;         // [m]
  double width = 40.0;                // of the world across the picture [m]

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("at", &VideoShot::at,
            {.unit = "s", .meaning = "scene time at which it begins", .minimum = 0.0});
    v.field("target", &VideoShot::target,
            {.meaning = "name of the target that stays in the middle of the picture"});
    v.field("center", &VideoShot::center,
            {.unit = "m",
             .meaning = "the middle of the picture; without it and without a target the camera "
                        "shows the whole region",
             .minimum = -1e7,
             .maximum = 1e7});
    v.field("width", &VideoShot::width,
            {.unit = "m",
             .meaning = "width of the picture in the world",
             .minimum = 0.1,
             .maximum = 1e5});
  }

  template <class Report>
  void check(Report&& report) const {
    if (target && center) report("center", "a shot has a target or a center, not both");
  }
};

/// A picture in the picture.
struct VideoCloseUp {
  static constexpr std::string_view about = "one target from near by, in a corner of the picture";

  std::string target;
  double width = 10.0;  // of the world across the close-up [m]
  VideoCorner corner = VideoCorner::kTopRight;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("target", &VideoCloseUp::target, {.meaning = "name of the target", .required = true});
    v.field("width", &VideoCloseUp::width,
            {.unit = "m",
             .meaning = "width of the close-up in the world",
             .minimum = 0.1,
             .maximum = 1e5});
    v.field("corner", &VideoCloseUp::corner, {.meaning = "where it lies"});
  }
};

/// The annotated video of a run.
struct VideoConfig {
  static constexpr std::string_view about = "an annotated video of the run";

  std::array<int, 2> size{1280, 720};  // width and height, both even [px]
  double fps = 30.0;                   // frames per second of video time [Hz]
  double slow = 1.0;                   // video time per scene time
  double from = 0.0;                   // scene time of the first frame [s]
  std::optional<double> to;            // scene time of the last frame; absent: the scene's end [s]
  std::vector<VideoLayer> show{kDefaultVideoLayers.begin(), kDefaultVideoLayers.end()};
  std::optional<double> trail;  // how far back paths, marks and trails reach [s]
  VideoTheme theme = VideoTheme::kDark;
  double text = 1.0;         // how much larger letters are than usual
  std::vector<Vec2> region;  // lower left and upper right corner; empty: all that happens [m]
  std::optional<std::string> follow;  // the target that stays in the middle of the picture
  double follow_width = 40.0;         // of the world across the picture when following [m]
  std::vector<VideoShot> shots;       // in the order of time
  double glide = 1.5;                 // scene time that the camera takes from shot to shot [s]
  std::optional<VideoCloseUp> close_up;

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
    v.field("trail", &VideoConfig::trail,
            {.unit = "s",
             .meaning = "how far back true paths, detections and tracks are shown; from the length "
                        "of the scene on they stay and do not fade; without it an eighth of the "
                        "scene, and 3 s of the video at least",
             .minimum = 0.0,
             .maximum = 1e6});
    v.field("theme", &VideoConfig::theme, {.meaning = "colours: light is for paper"});
    v.field("text", &VideoConfig::text,
            {.unit = "1",
             .meaning = "how much larger letters are than usual; 1.5 suits a large room",
             .minimum = 0.5,
             .maximum = 3.0});
    v.field("region", &VideoConfig::region,
            {.unit = "m",
             .meaning = "lower left and upper right corner of what is shown; without it all that "
                        "happens",
             .minimum = -1e7,
             .maximum = 1e7,
             .max_items = 2});
    v.field("follow", &VideoConfig::follow,
            {.meaning = "name of the target that stays in the middle of the picture all the time"});
    v.field("follow_width", &VideoConfig::follow_width,
            {.unit = "m",
             .meaning = "width of the picture in the world when following a target",
             .minimum = 0.1,
             .maximum = 1e5});
    v.field("shots", &VideoConfig::shots,
            {.meaning = "where the camera looks, in the order of time; before the first it shows "
                        "the whole region",
             .max_items = 1000});
    v.field("glide", &VideoConfig::glide,
            {.unit = "s",
             .meaning = "scene time that the camera takes from one shot to the next",
             .minimum = 0.0,
             .maximum = 1e6});
    v.field("close_up", &VideoConfig::close_up, {.meaning = "a picture in the picture"});
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
    if (follow && !shots.empty()) report("follow", "says where the camera looks, as 'shots' does");
    for (std::size_t i = 1; i < shots.size(); ++i) {
      if (shots[i].at > shots[i - 1].at) continue;
      report("shots[" + std::to_string(i) + "].at", "must be later than the shot before");
    }
  }
};

}  // namespace ghtrack

#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace ghtrack {

/// What a picture may show, from back to front.
enum class VideoLayer : std::uint32_t {
  kGrid,
  kFieldOfView,
  kGround,
  kWalls,
  kRails,
  kWind,
  kTruth,
  kNames,
  kTrails,
  kSmoothed,
  kGates,
  kResiduals,
  kDetections,
  kClutter,
  kTentative,
  kTracks,
  kEvents,
  kFans,
  kLabels,
  kInsets,
  kHud,
  kLegend,
};

/// The layers as scenes and options name them.
constexpr std::array<std::pair<std::string_view, VideoLayer>, 22> enum_names(VideoLayer) {
  return {{{"grid", VideoLayer::kGrid},
           {"field-of-view", VideoLayer::kFieldOfView},
           {"ground", VideoLayer::kGround},
           {"walls", VideoLayer::kWalls},
           {"rails", VideoLayer::kRails},
           {"wind", VideoLayer::kWind},
           {"truth", VideoLayer::kTruth},
           {"names", VideoLayer::kNames},
           {"trails", VideoLayer::kTrails},
           {"smoothed", VideoLayer::kSmoothed},
           {"gates", VideoLayer::kGates},
           {"residuals", VideoLayer::kResiduals},
           {"detections", VideoLayer::kDetections},
           {"clutter", VideoLayer::kClutter},
           {"tentative", VideoLayer::kTentative},
           {"tracks", VideoLayer::kTracks},
           {"events", VideoLayer::kEvents},
           {"fans", VideoLayer::kFans},
           {"labels", VideoLayer::kLabels},
           {"insets", VideoLayer::kInsets},
           {"hud", VideoLayer::kHud},
           {"legend", VideoLayer::kLegend}}};
}

/// What a video shows unless told otherwise: all but the names of the true objects, the paths as
/// they are known afterwards, the fans of future positions and the inset plots.
inline constexpr std::array kDefaultVideoLayers{
    VideoLayer::kGrid,      VideoLayer::kFieldOfView, VideoLayer::kGround,     VideoLayer::kWalls,
    VideoLayer::kRails,     VideoLayer::kWind,        VideoLayer::kTruth,      VideoLayer::kTrails,
    VideoLayer::kGates,     VideoLayer::kResiduals,   VideoLayer::kDetections, VideoLayer::kClutter,
    VideoLayer::kTentative, VideoLayer::kTracks,      VideoLayer::kEvents,     VideoLayer::kLabels,
    VideoLayer::kHud,       VideoLayer::kLegend};

}  // namespace ghtrack

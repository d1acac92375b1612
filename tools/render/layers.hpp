#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

namespace ghtrack::render {

/// What a picture may show, from back to front.
enum class Layer : std::uint32_t {
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

/// The layers as scenes and options name them.
constexpr std::array<std::pair<std::string_view, Layer>, 18> enum_names(Layer) {
  return {{{"grid", Layer::kGrid},
           {"field-of-view", Layer::kFieldOfView},
           {"ground", Layer::kGround},
           {"rails", Layer::kRails},
           {"wind", Layer::kWind},
           {"truth", Layer::kTruth},
           {"names", Layer::kNames},
           {"trails", Layer::kTrails},
           {"gates", Layer::kGates},
           {"residuals", Layer::kResiduals},
           {"detections", Layer::kDetections},
           {"clutter", Layer::kClutter},
           {"tracks", Layer::kTracks},
           {"fans", Layer::kFans},
           {"labels", Layer::kLabels},
           {"insets", Layer::kInsets},
           {"hud", Layer::kHud},
           {"legend", Layer::kLegend}}};
}

/// The layer of that name, if there is one.
constexpr std::optional<Layer> layer_named(std::string_view name) {
  for (const auto& [layer_name, layer] : enum_names(Layer{}))
    if (layer_name == name) return layer;
  return std::nullopt;
}

/// A set of layers.
class Layers {
 public:
  constexpr Layers() = default;
  constexpr Layers(std::initializer_list<Layer> layers) {
    for (const Layer layer : layers) show(layer);
  }

  constexpr bool shows(Layer layer) const { return (bits_ & bit(layer)) != 0; }
  constexpr void show(Layer layer) { bits_ |= bit(layer); }
  constexpr void hide(Layer layer) { bits_ &= ~bit(layer); }

  bool operator==(const Layers&) const = default;

 private:
  static constexpr std::uint32_t bit(Layer layer) {
    return std::uint32_t{1} << static_cast<std::uint32_t>(layer);
  }
  std::uint32_t bits_ = 0;
};

/// What a video shows unless told otherwise: all but the names of the true objects, the fans of
/// future positions and the inset plots.
inline constexpr Layers kDefaultLayers{
    Layer::kGrid,    Layer::kFieldOfView, Layer::kGround, Layer::kRails,     Layer::kWind,
    Layer::kTruth,   Layer::kTrails,      Layer::kGates,  Layer::kResiduals, Layer::kDetections,
    Layer::kClutter, Layer::kTracks,      Layer::kLabels, Layer::kHud,       Layer::kLegend};

}  // namespace ghtrack::render

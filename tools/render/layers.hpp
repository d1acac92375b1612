#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "scenes/schema/video_layer.hpp"

namespace ghtrack::render {

using Layer = VideoLayer;

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
  constexpr explicit Layers(std::span<const Layer> layers) {
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

inline constexpr Layers kDefaultLayers{kDefaultVideoLayers};

}  // namespace ghtrack::render

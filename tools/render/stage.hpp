#pragma once

#include <span>

#include "tools/render/style.hpp"
#include "tools/render/view.hpp"

namespace ghtrack::render {

/// What everything that is drawn into one view of the world shares.
struct Stage {
  const View& view;
  const SceneDrawing& scene;
  Layers layers;
  const Style& style;
  const Typefaces& fonts;
  std::span<const Viewport> covered = {};  // by close-ups

  bool shows(Layer layer) const { return layers.shows(layer); }
};

}  // namespace ghtrack::render

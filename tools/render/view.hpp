#pragma once

#include "tools/render/video.hpp"

namespace ghtrack::render {

/// A rectangle of the picture [px], x right, y down.
struct Viewport {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  bool operator==(const Viewport&) const = default;
};

/// A point of the picture [px], x right, y down; the centre of the first pixel is (0, 0).
struct Pixel {
  double x = 0.0;
  double y = 0.0;
};

/// The map from the world (x right, y up) to the picture: one scale for both axes.
class View {
 public:
  /// Shows the whole world rectangle in the middle of the viewport.
  View(const Rectangle& world, const Viewport& viewport);

  Pixel to_pixel(const Vec2& world) const {
    return {viewport_.left + 0.5 * viewport_.width + (world.x() - centre_.x()) * scale_,
            viewport_.top + 0.5 * viewport_.height - (world.y() - centre_.y()) * scale_};
  }
  Vec2 to_world(const Pixel& pixel) const;

  double scale() const { return scale_; }  // [px/m]
  const Viewport& viewport() const { return viewport_; }

  /// What the viewport shows: at least the rectangle asked for.
  Rectangle world() const;

  bool operator==(const View&) const = default;

 private:
  Viewport viewport_;
  Vec2 centre_;
  double scale_;
};

}  // namespace ghtrack::render

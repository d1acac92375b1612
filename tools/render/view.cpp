#include "tools/render/view.hpp"

#include <algorithm>
#include <cmath>

namespace ghtrack::render {

namespace {

constexpr double kSmallestWorld = 1e-3;  // [m]
constexpr double kLargestWorld = 1e9;    // [m]

/// A rectangle that can be shown: finite, not empty, not inside out.
Rectangle sane(Rectangle world) {
  for (int axis = 0; axis < 2; ++axis) {
    double& low = world.min[axis];
    double& high = world.max[axis];
    if (!std::isfinite(low) || !std::isfinite(high)) {
      low = -10.0;
      high = 10.0;
    }
    low = std::clamp(low, -kLargestWorld, kLargestWorld);
    high = std::clamp(high, -kLargestWorld, kLargestWorld);
    if (high - low < kSmallestWorld) {
      const double middle = 0.5 * (low + high);
      low = middle - 0.5 * kSmallestWorld;
      high = middle + 0.5 * kSmallestWorld;
    }
  }
  return world;
}

}  // namespace

View::View(const Rectangle& world, const Viewport& viewport) : viewport_(viewport) {
  const Rectangle shown = sane(world);
  const Vec2 size = shown.max - shown.min;
  centre_ = 0.5 * (shown.min + shown.max);
  scale_ = std::min(viewport.width / size.x(), viewport.height / size.y());
}

Vec2 View::to_world(const Pixel& pixel) const {
  return {centre_.x() + (pixel.x - viewport_.left - 0.5 * viewport_.width) / scale_,
          centre_.y() - (pixel.y - viewport_.top - 0.5 * viewport_.height) / scale_};
}

Rectangle View::world() const {
  const Vec2 half(0.5 * viewport_.width / scale_, 0.5 * viewport_.height / scale_);
  return {centre_ - half, centre_ + half};
}

std::optional<Rectangle> bounding_rectangle(const std::vector<Vec2>& points, double margin) {
  std::optional<Rectangle> bounds;
  for (const Vec2& point : points) {
    if (!point.allFinite()) continue;
    if (!bounds) bounds = Rectangle{point, point};
    bounds->min = bounds->min.cwiseMin(point);
    bounds->max = bounds->max.cwiseMax(point);
  }
  if (!bounds) return bounds;
  const Vec2 size = bounds->max - bounds->min;
  const double extra = margin * std::max(size.x(), size.y());
  bounds->min.array() -= extra;
  bounds->max.array() += extra;
  return bounds;
}

Rectangle world_of(const SceneDrawing& scene) {
  if (scene.world) return *scene.world;
  std::vector<Vec2> points;
  for (const SensorDrawing& sensor : scene.sensors)
    points.insert(points.end(), sensor.field_of_view.begin(), sensor.field_of_view.end());
  for (const std::vector<Vec2>& rail : scene.rails)
    points.insert(points.end(), rail.begin(), rail.end());
  for (const Wall& wall : scene.walls) {
    points.push_back(wall.from);
    points.push_back(wall.to);
  }
  for (const SolidBox& box : scene.boxes) {
    for (const Vec2& corner : box.corners()) points.push_back(corner);
  }
  return bounding_rectangle(points).value_or(Rectangle{Vec2(-10.0, -10.0), Vec2(10.0, 10.0)});
}

}  // namespace ghtrack::render

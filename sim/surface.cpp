#include "sim/surface.hpp"

#include <algorithm>

namespace ghtrack {

Surface::Surface(const Ground& ground)
    : shape(Shape::kGround),
      from(0.0, ground.height),
      to(1.0, ground.height),
      restitution(ground.restitution),
      friction(ground.friction) {}

Surface::Surface(const Wall& wall)
    : shape(Shape::kWall),
      from(wall.from),
      to(wall.to),
      restitution(wall.restitution),
      friction(wall.friction) {}

Contact Surface::contact(const Vec2& point) const {
  if (shape == Shape::kGround) return {Vec2::UnitY(), point.y() - from.y(), true};
  const Vec2 along = to - from;
  const double fraction = (point - from).dot(along) / along.squaredNorm();
  const Vec2 nearest = from + std::clamp(fraction, 0.0, 1.0) * along;
  const Vec2 apart = point - nearest;
  const double distance = apart.norm();
  const bool on_face = fraction >= 0.0 && fraction <= 1.0;
  if (distance > 0.0) return {apart / distance, distance, on_face};
  return {Vec2(-along.y(), along.x()).normalized(), 0.0, on_face};
}

}  // namespace ghtrack

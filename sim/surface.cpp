#include "sim/surface.hpp"

#include <algorithm>
#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {

namespace {

constexpr double kFarAway = 1e6;  // where level ground beyond a profile ends [m]

}  // namespace

std::span<const Material> materials() {
  // Restitution of grass: FIFA Quality Programme, a football dropped from 2 m rises 0.6 to 0.85 m.
  // Friction: usual values of engineering tables for rubber, leather and felt on the material.
  static constexpr std::array<Material, 8> kMaterials{{
      {"plain", {}, {}},
      {"concrete", {}, 0.6},
      {"asphalt", {}, 0.7},
      {"hardwood", {}, 0.5},
      {"ice", {}, 0.03},
      {"rubber", {}, 0.9},
      {"grass", 0.6, 0.4},
      {"sand", 0.1, 0.7},
  }};
  return kMaterials;
}

double Ground::height_at(double x) const {
  if (profile.empty()) return height;
  const auto right = std::find_if(profile.begin(), profile.end(),
                                  [x](const Vec2& point) { return point.x() > x; });
  if (right == profile.begin()) return profile.front().y();
  if (right == profile.end()) return profile.back().y();
  const Vec2& before = *(right - 1);
  const double fraction = (x - before.x()) / (right->x() - before.x());
  return before.y() + fraction * (right->y() - before.y());
}

std::array<Vec2, 4> SolidBox::corners() const {
  const portable::SinCos turn = portable::sin_cos_of_turns(angle_deg / 360.0);
  const Vec2 along = 0.5 * size.x() * Vec2(turn.cos, turn.sin);
  const Vec2 up = 0.5 * size.y() * Vec2(-turn.sin, turn.cos);
  return {center - along - up, center + along - up, center + along + up, center - along + up};
}

bool SolidBox::contains(const Vec2& point) const {
  const portable::SinCos turn = portable::sin_cos_of_turns(angle_deg / 360.0);
  const Vec2 away = point - center;
  return std::abs(away.dot(Vec2(turn.cos, turn.sin))) <= 0.5 * size.x() &&
         std::abs(away.dot(Vec2(-turn.sin, turn.cos))) <= 0.5 * size.y();
}

void append_surfaces(const Ground& ground, std::vector<Surface>& surfaces) {
  using Shape = Surface::Shape;
  const auto append = [&](Shape shape, const Vec2& from, const Vec2& to) {
    surfaces.push_back({shape, from, to, ground.restitution, ground.friction});
  };
  if (ground.profile.empty()) {
    append(Shape::kGround, Vec2(0.0, ground.height), Vec2(1.0, ground.height));
    return;
  }
  const Vec2& first = ground.profile.front();
  append(Shape::kWall, Vec2(-kFarAway, first.y()), first);
  for (std::size_t i = 1; i < ground.profile.size(); ++i) {
    append(Shape::kWall, ground.profile[i - 1], ground.profile[i]);
  }
  const Vec2& last = ground.profile.back();
  append(Shape::kWall, last, Vec2(kFarAway, last.y()));
}

void append_surfaces(const Wall& wall, std::vector<Surface>& surfaces) {
  surfaces.push_back({Surface::Shape::kWall, wall.from, wall.to, wall.restitution, wall.friction});
}

void append_surfaces(const SolidBox& box, std::vector<Surface>& surfaces) {
  const std::array<Vec2, 4> corners = box.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    surfaces.push_back({Surface::Shape::kWall, corners[i], corners[(i + 1) % corners.size()],
                        box.restitution, box.friction});
  }
}

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

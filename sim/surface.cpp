#include "sim/surface.hpp"

#include <algorithm>
#include <cmath>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {

namespace {

constexpr double kFarAway = 1e6;  // where level ground beyond a profile ends [m]

}  // namespace

std::span<const Material> materials() {
  // Restitution of grass: FIFA Quality Programme, a football dropped from 2 m rises 0.6 to 0.85 m.
  // Friction: usual values of engineering tables for rubber, leather and felt on the material.
  // Rolling resistance c: a rolling ball slows down by c g / (1 + I / m r²).
  //   grass   FIFA Quality Programme: a football from a ramp 1 m high rolls 4 to 10 m; 0.12 is 8 m
  //   green   Stimpmeter: a golf ball at 1.83 m/s rolls 10 ft on a medium fast green
  //   cloth   Alciatore, The Illustrated Principles of Pool and Billiards: 0.005 to 0.015
  //   others  wheels in engineering tables (Wong, Theory of Ground Vehicles): concrete and asphalt
  //           0.010 to 0.015, loose sand 0.3; steel and leather on boards, rubber mats and ice less
  //           well known
  static constexpr std::array<Material, 10> kMaterials{{
      {"plain", {}, {}, {}},
      {"concrete", {}, 0.6, 0.010},
      {"asphalt", {}, 0.7, 0.012},
      {"hardwood", {}, 0.5, 0.008},
      {"ice", {}, 0.03, 0.002},
      {"rubber", {}, 0.9, 0.02},
      {"grass", 0.6, 0.4, 0.12},
      {"green", 0.4, 0.4, 0.078},
      {"cloth", 0.5, 0.2, 0.010},
      {"sand", 0.1, 0.7, 0.3},
  }};
  return kMaterials;
}

double Ground::height_at(double x) const {
  if (profile.empty()) return height;
  if (smooth) return ProfileCurve(profile).height_at(x);
  const auto right = std::find_if(profile.begin(), profile.end(),
                                  [x](const Vec2& point) { return point.x() > x; });
  if (right == profile.begin()) return profile.front().y();
  if (right == profile.end()) return profile.back().y();
  const Vec2& before = *(right - 1);
  const double fraction = (x - before.x()) / (right->x() - before.x());
  return before.y() + fraction * (right->y() - before.y());
}

double Ground::lowest() const {
  const std::vector<Vec2> points = outline();
  double lowest = points.empty() ? height : points.front().y();
  for (const Vec2& point : points) lowest = std::min(lowest, point.y());
  return lowest;
}

std::vector<Vec2> Ground::outline() const {
  if (!smooth || profile.empty()) return profile;
  constexpr int kParts = 24;  // of each piece of the spline
  const ProfileCurve curve(profile);
  std::vector<Vec2> points{profile.front()};
  for (std::size_t i = 1; i < profile.size(); ++i) {
    for (int k = 1; k <= kParts; ++k) {
      const double part = static_cast<double>(k) / kParts;
      const double x = (1.0 - part) * profile[i - 1].x() + part * profile[i].x();
      points.emplace_back(x, curve.height_at(x));
    }
  }
  return points;
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
  const auto append = [&](Shape shape, const Vec2& from, const Vec2& to) -> Surface& {
    return surfaces.emplace_back(
        Surface{shape, from, to, ground.restitution, ground.friction, ground.rolling});
  };
  if (ground.profile.empty()) {
    append(Shape::kGround, Vec2(0.0, ground.height), Vec2(1.0, ground.height));
    return;
  }
  const Vec2& first = ground.profile.front();
  const Vec2& last = ground.profile.back();
  if (ground.smooth) {
    append(Shape::kCurve, first, last).curve = std::make_shared<ProfileCurve>(ground.profile);
    return;
  }
  append(Shape::kWall, Vec2(-kFarAway, first.y()), first);
  for (std::size_t i = 1; i < ground.profile.size(); ++i) {
    append(Shape::kWall, ground.profile[i - 1], ground.profile[i]);
  }
  append(Shape::kWall, last, Vec2(kFarAway, last.y()));
}

void append_surfaces(const Wall& wall, std::vector<Surface>& surfaces) {
  surfaces.push_back(
      {Surface::Shape::kWall, wall.from, wall.to, wall.restitution, wall.friction, wall.rolling});
}

void append_surfaces(const SolidBox& box, std::vector<Surface>& surfaces) {
  const std::array<Vec2, 4> corners = box.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    surfaces.push_back({Surface::Shape::kWall, corners[i], corners[(i + 1) % corners.size()],
                        box.restitution, box.friction, box.rolling});
  }
}

Contact contact_with_disc(const Vec2& apart, double radius) {
  const double distance = apart.norm();
  if (distance == 0.0) return {Vec2::UnitY(), -radius, true, 0.0};
  return {apart / distance, distance - radius, true, 1.0 / distance};
}

Contact contact_with_rectangle(const Vec2& point, double length, double width) {
  const Vec2 half(0.5 * length, 0.5 * width);
  const Vec2 sign(std::copysign(1.0, point.x()), std::copysign(1.0, point.y()));
  const Vec2 beyond = point.cwiseAbs() - half;
  if (beyond.x() > 0.0 && beyond.y() > 0.0) {
    const double distance = beyond.norm();
    return {sign.cwiseProduct(beyond) / distance, distance, false, 1.0 / distance};
  }
  if (beyond.x() > beyond.y()) return {Vec2(sign.x(), 0.0), beyond.x(), true, 0.0};
  return {Vec2(0.0, sign.y()), beyond.y(), true, 0.0};
}

Contact contact_with_outline(const Vec2& point, const Vec2& position, double angle,
                             const Outline& outline) {
  const Vec2 apart = point - position;
  if (outline.shape != Outline::Shape::kBox) return contact_with_disc(apart, 0.5 * outline.length);
  const Vec2 along = direction(angle);
  const Vec2 across = left_of(along);
  Contact contact = contact_with_rectangle(Vec2(apart.dot(along), apart.dot(across)),
                                           outline.length, outline.width);
  contact.normal = contact.normal.x() * along + contact.normal.y() * across;
  return contact;
}

Contact Surface::contact(const Vec2& point) const {
  if (shape == Shape::kGround) return {Vec2::UnitY(), point.y() - from.y(), true, 0.0};
  if (shape == Shape::kCurve) {
    const ProfileCurve::Nearest nearest = curve->nearest(point);
    return {nearest.normal, nearest.distance, true, nearest.curvature};
  }
  const Vec2 along = to - from;
  const double fraction = (point - from).dot(along) / along.squaredNorm();
  const Vec2 nearest = from + std::clamp(fraction, 0.0, 1.0) * along;
  const Vec2 apart = point - nearest;
  const double distance = apart.norm();
  const bool on_face = fraction >= 0.0 && fraction <= 1.0;
  if (distance > 0.0) return {apart / distance, distance, on_face, on_face ? 0.0 : 1.0 / distance};
  return {left_of(along).normalized(), 0.0, on_face, 0.0};
}

}  // namespace ghtrack

#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/profile_curve.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// What is known of bouncing and rolling on a material, whatever does so.
struct Material {
  std::string_view name;
  std::optional<double> restitution;  // hard materials: that of the ball, which is measured on them
  std::optional<double> friction = std::nullopt;
  std::optional<double> rolling = std::nullopt;
};

/// The materials that a scene can name; the first says nothing.
std::span<const Material> materials();

/// Those materials as presets of a surface.
template <class SurfaceConfig>
std::span<const SurfaceConfig> surfaces_of_all_materials() {
  static const std::vector<SurfaceConfig> rows = [] {
    std::vector<SurfaceConfig> surfaces;
    for (const Material& material : materials()) {
      SurfaceConfig& surface = surfaces.emplace_back();
      surface.material = material.name;
      surface.restitution = material.restitution;
      surface.friction = material.friction;
      surface.rolling = material.rolling;
    }
    return surfaces;
  }();
  return rows;
}

/// The keys that ground, walls and boxes share.
template <class SurfaceConfig, class Visitor>
void describe_material(Visitor& v) {
  v.preset("material", &SurfaceConfig::material, surfaces_of_all_materials<SurfaceConfig>(),
           {.meaning = "what it is made of"});
  v.field("restitution", &SurfaceConfig::restitution,
          {.unit = "1",
           .meaning = "speed ratio of a bounce on it; left out: each ball's own",
           .minimum = 0.0,
           .maximum = 1.0});
  v.field("friction", &SurfaceConfig::friction,
          {.unit = "1",
           .meaning = "coefficient of sliding friction on it; left out: each ball's own",
           .minimum = 0.0,
           .maximum = 10.0});
  v.field("rolling", &SurfaceConfig::rolling,
          {.unit = "1",
           .meaning = "coefficient of rolling resistance on it; left out: each ball's own",
           .minimum = 0.0,
           .maximum = 1.0});
}

/// The ground of a side view: level, a profile of straight slopes, or a smooth one.
struct Ground {
  static constexpr std::string_view about =
      "ground on which balls and balloons bounce: level, or with a profile";

  double height = 0.0;
  std::optional<double> restitution = std::nullopt;
  std::optional<double> friction = std::nullopt;
  std::optional<double> rolling = std::nullopt;
  std::string material = "plain";
  std::vector<Vec2> profile = {};
  bool smooth = false;

  /// y of the ground below or above a point [m].
  double height_at(double x) const;

  /// y of its lowest point [m].
  double lowest() const;

  /// Points of a line that looks like its profile, from left to right [m]; none if it is level.
  std::vector<Vec2> outline() const;

  template <class Visitor>
  static void describe(Visitor& v) {
    describe_material<Ground>(v);
    v.field("height", &Ground::height,
            {.unit = "m",
             .meaning = "y of level ground, from which wind shear is measured",
             .minimum = -1e5,
             .maximum = 1e5});
    v.field("profile", &Ground::profile,
            {.unit = "m",
             .meaning = "points from left to right, joined by slopes; level beyond both ends. "
                        "Without it the ground is level",
             .minimum = -1e5,
             .maximum = 1e5,
             .max_items = 1000});
    v.field("smooth", &Ground::smooth,
            {.meaning = "join the points of `profile` by a cubic spline, without edges"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (profile.size() == 1) report("profile", "a profile needs at least two points");
    for (std::size_t i = 1; i < profile.size(); ++i) {
      if (profile[i].x() >= profile[i - 1].x() + 0.01) continue;
      report("profile", "each point must lie to the right of the one before, by 0.01 m at least");
      break;
    }
  }
};

/// A straight wall, ramp or platform, solid from both sides.
struct Wall {
  static constexpr std::string_view about =
      "a straight wall, ramp or platform, solid on both sides";

  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  std::optional<double> restitution = std::nullopt;
  std::optional<double> friction = std::nullopt;
  std::optional<double> rolling = std::nullopt;
  std::string material = "plain";

  template <class Visitor>
  static void describe(Visitor& v) {
    describe_material<Wall>(v);
    v.field("from", &Wall::from,
            {.unit = "m", .meaning = "one end", .required = true, .minimum = -1e5, .maximum = 1e5});
    v.field(
        "to", &Wall::to,
        {.unit = "m", .meaning = "other end", .required = true, .minimum = -1e5, .maximum = 1e5});
  }

  template <class Report>
  void check(Report&& report) const {
    if ((to - from).norm() < 0.01) report("to", "a wall must be at least 0.01 m long");
  }
};

/// A rectangular block that stands still.
struct SolidBox {
  static constexpr std::string_view about = "a rectangular block that stands still";

  Vec2 center = Vec2::Zero();
  Vec2 size = Vec2::Ones();
  double angle_deg = 0.0;
  std::optional<double> restitution = std::nullopt;
  std::optional<double> friction = std::nullopt;
  std::optional<double> rolling = std::nullopt;
  std::string material = "plain";

  /// Counter-clockwise, beginning at the lower left of the unturned box [m].
  std::array<Vec2, 4> corners() const;

  bool contains(const Vec2& point) const;

  template <class Visitor>
  static void describe(Visitor& v) {
    describe_material<SolidBox>(v);
    v.field(
        "center", &SolidBox::center,
        {.unit = "m", .meaning = "of the box", .required = true, .minimum = -1e5, .maximum = 1e5});
    v.field("size", &SolidBox::size,
            {.unit = "m", .meaning = "width and height", .minimum = 0.01, .maximum = 1e4});
    v.field(
        "angle_deg", &SolidBox::angle_deg,
        {.unit = "deg", .meaning = "by which it is turned", .minimum = -360.0, .maximum = 360.0});
  }
};

/// Where a point stands to a surface.
struct Contact {
  Vec2 normal = Vec2::UnitY();  // from the surface's nearest point to the point
  double distance = 0.0;        // [m]; negative below the ground
  bool on_face = true;          // not beyond the end of a wall
  /// Of the line of points at this distance, positive where the surface bulges towards the point:
  /// 0 over a face, 1/distance around the end of a wall [1/m].
  double curvature = 0.0;
};

/// Where a point stands to a disc or another point, `apart` from its centre.
Contact contact_with_disc(const Vec2& apart, double radius);

/// Where a point stands to an upright rectangle around the origin.
Contact contact_with_rectangle(const Vec2& point, double length, double width);

/// Where a point stands to a body of that outline, placed and turned.
Contact contact_with_outline(const Vec2& point, const Vec2& position, double angle,
                             const Outline& outline);

/// What a round body can touch: the half-plane below a level, a segment, or a smooth curve with
/// solid ground below it.
struct Surface {
  enum class Shape { kGround, kWall, kCurve };
  Shape shape = Shape::kGround;
  Vec2 from = Vec2::Zero();  // ground: any point of it
  Vec2 to = Vec2::Zero();
  std::optional<double> restitution = std::nullopt;
  std::optional<double> friction = std::nullopt;
  std::optional<double> rolling = std::nullopt;
  std::shared_ptr<const ProfileCurve> curve = nullptr;

  Contact contact(const Vec2& point) const;
};

/// What each of these is made of.
void append_surfaces(const Ground& ground, std::vector<Surface>& surfaces);
void append_surfaces(const Wall& wall, std::vector<Surface>& surfaces);
void append_surfaces(const SolidBox& box, std::vector<Surface>& surfaces);

}  // namespace ghtrack

#pragma once

#include <optional>
#include <string_view>

#include "sim/truth.hpp"

namespace ghtrack {

/// The level ground of a side view.
struct Ground {
  static constexpr std::string_view about = "level ground on which balls and balloons bounce";

  double height = 0.0;
  std::optional<double> restitution;
  std::optional<double> friction;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("height", &Ground::height,
            {.unit = "m", .meaning = "y of the ground", .minimum = -1e5, .maximum = 1e5});
    v.field("restitution", &Ground::restitution,
            {.unit = "1",
             .meaning = "speed ratio of a bounce on it; left out: each ball's own",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("friction", &Ground::friction,
            {.unit = "1",
             .meaning = "coefficient of sliding friction on it; left out: each ball's own",
             .minimum = 0.0,
             .maximum = 10.0});
  }
};

/// A straight wall, ramp or platform, solid from both sides.
struct Wall {
  static constexpr std::string_view about =
      "a straight wall, ramp or platform, solid on both sides";

  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  std::optional<double> restitution;
  std::optional<double> friction;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("from", &Wall::from,
            {.unit = "m", .meaning = "one end", .required = true, .minimum = -1e5, .maximum = 1e5});
    v.field(
        "to", &Wall::to,
        {.unit = "m", .meaning = "other end", .required = true, .minimum = -1e5, .maximum = 1e5});
    v.field("restitution", &Wall::restitution,
            {.unit = "1",
             .meaning = "speed ratio of a bounce off it; left out: each ball's own",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("friction", &Wall::friction,
            {.unit = "1",
             .meaning = "coefficient of sliding friction on it; left out: each ball's own",
             .minimum = 0.0,
             .maximum = 10.0});
  }

  template <class Report>
  void check(Report&& report) const {
    if ((to - from).norm() < 0.01) report("to", "a wall must be at least 0.01 m long");
  }
};

/// Where a point stands to a surface.
struct Contact {
  Vec2 normal = Vec2::UnitY();  // from the surface's nearest point to the point
  double distance = 0.0;        // [m]; negative below the ground
  bool on_face = true;          // not beyond the end of a wall
};

/// What a round body can touch: the half-plane below a level, or a segment.
struct Surface {
  enum class Shape { kGround, kWall };
  Shape shape = Shape::kGround;
  Vec2 from = Vec2::Zero();  // ground: any point of it
  Vec2 to = Vec2::Zero();
  std::optional<double> restitution;
  std::optional<double> friction;

  explicit Surface(const Ground& ground);
  explicit Surface(const Wall& wall);

  Contact contact(const Vec2& point) const;
};

}  // namespace ghtrack

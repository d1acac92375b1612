#pragma once

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/truth.hpp"

namespace ghtrack {

/// `straight: 120`
struct Straight {
  static constexpr std::string_view kind = "straight";
  double length = 100.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&Straight::length,
             {.unit = "m", .meaning = "a straight of this length", .above = 0.0, .maximum = 1e6});
  }
};

/// A circular arc, with transition curves at both ends if asked for.
struct Curve {
  static constexpr std::string_view kind = "curve";
  static constexpr std::string_view about =
      "a circular arc, to the left where radius and angle are positive";
  double radius = 300.0;
  std::optional<double> angle_deg;
  std::optional<double> length;
  double transition = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("radius", &Curve::radius,
            {.unit = "m",
             .meaning = "negative: to the right",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("angle_deg", &Curve::angle_deg,
            {.unit = "deg",
             .meaning = "turned through by the arc alone; negative: to the right",
             .minimum = -3600.0,
             .maximum = 3600.0});
    v.field("length", &Curve::length,
            {.unit = "m",
             .meaning = "of the arc alone, instead of angle_deg",
             .above = 0.0,
             .maximum = 1e6});
    v.field("transition", &Curve::transition,
            {.unit = "m",
             .meaning = "length of the clothoids before and after the arc",
             .minimum = 0.0,
             .maximum = 5000.0});
  }

  template <class Report>
  void check(Report&& report) const {
    if (std::abs(radius) < 10.0) report("radius", "must be at least 10 m");
    if (angle_deg.has_value() == length.has_value()) {
      report("angle_deg", "a curve needs either angle_deg or length");
    }
  }
};

/// A transition curve: its curvature changes linearly from that of the element before.
struct Clothoid {
  static constexpr std::string_view kind = "clothoid";
  static constexpr std::string_view about =
      "a transition whose curvature changes linearly from that of the element before";
  double length = 50.0;
  std::optional<double> radius;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("length", &Clothoid::length,
            {.unit = "m",
             .meaning = "along the track",
             .required = true,
             .above = 0.0,
             .maximum = 5000.0});
    v.field("radius", &Clothoid::radius,
            {.unit = "m",
             .meaning = "at its end, negative to the right; left out: straight",
             .minimum = -1e6,
             .maximum = 1e6});
  }

  template <class Report>
  void check(Report&& report) const {
    if (radius && std::abs(*radius) < 10.0) report("radius", "must be at least 10 m");
  }
};

using TrackElement = std::variant<Straight, Curve, Clothoid>;

/// A point of the track.
struct TrackPoint {
  Vec2 position = Vec2::Zero();  // [m]
  double heading = 0.0;          // [rad]
  double curvature = 0.0;        // positive to the left [1/m]
};

/// Mean of the direction of travel over a length whose heading is a quadratic of the arc length:
/// along a straight, an arc or a clothoid.
/// @param heading, curvature  at its beginning [rad, 1/m]
Vec2 mean_direction(double heading, double curvature, double curvature_rate, double length);

/// A line of straights, arcs and clothoids, by arc length; straight before and after its ends.
class RailLine {
 public:
  /// @param heading  direction at arc length 0 [rad]
  RailLine(const std::vector<TrackElement>& elements, const Vec2& origin, double heading);

  TrackPoint at(double arc_length) const;

  /// Curvature alone [1/m].
  double curvature(double arc_length) const;

  double length() const { return length_; }

  /// Where its first bend begins and its last one ends [m]; none if it is straight throughout.
  std::optional<std::pair<double, double>> bends() const;

 private:
  struct Piece {
    double begin;  // arc length [m]
    double length;
    TrackPoint start;
    double curvature_rate;  // [1/m²]
  };
  static TrackPoint along(const Piece& piece, double distance);
  const Piece& piece_at(double arc_length) const;
  void append(double length, double from_curvature, double to_curvature);

  std::vector<Piece> pieces_;  // the first and the last are the endless straights
  double length_ = 0.0;
};

/// How a line lies on another that is the same curve: its arc length s is begin + direction × s
/// there.
struct PlaceOnLine {
  double begin = 0.0;      // [m]
  double direction = 1.0;  // −1: they run against each other
};

/// Nothing if the two are not the same curve in the plane, from end to end.
std::optional<PlaceOnLine> place_on(const RailLine& line, const RailLine& other);

/// A number that is equal, but for rounding, for lines that are the same curve.
double mark_of(const RailLine& line);

}  // namespace ghtrack

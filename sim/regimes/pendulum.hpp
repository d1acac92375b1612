#pragma once

#include <string_view>

#include "sim/regimes/motion.hpp"

namespace ghtrack {

class PendulumModel;

/// A bob on a massless rod, at any angle:
///   d²θ/dt² = −(g/l) sin θ − c dθ/dt,  θ from the vertical below the pivot, counter-clockwise.
/// The rod constrains the motion: nothing that the bob hits moves it from its circle.
struct Pendulum {
  static constexpr std::string_view kind = "pendulum";
  static constexpr std::string_view about =
      "a bob on a rod: constrained motion at any angle, with linear damping if wanted";
  using Model = PendulumModel;

  Vec2 position = Vec2::Zero();
  double length = 5.0;
  double angle_deg = 45.0;
  double rate_deg = 0.0;
  double damping = 0.0;
  double radius = 0.2;

  void shift(const Vec2& by) { position += by; }
  void hasten(const Vec2& by);
  std::string_view unreleasable() const { return "nothing can release a pendulum"; }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("position", &Pendulum::position,
            {.unit = "m",
             .meaning = "of the pivot",
             .required = true,
             .minimum = -1e5,
             .maximum = 1e5});
    v.field("length", &Pendulum::length,
            {.unit = "m",
             .meaning = "from the pivot to the bob's centre",
             .minimum = 0.05,
             .maximum = 1000.0});
    v.field("angle_deg", &Pendulum::angle_deg,
            {.unit = "deg",
             .meaning = "at the start, from hanging straight down, counter-clockwise",
             .minimum = -360.0,
             .maximum = 360.0});
    v.field("rate_deg", &Pendulum::rate_deg,
            {.unit = "deg/s", .meaning = "at the start", .minimum = -3600.0, .maximum = 3600.0});
    v.field("damping", &Pendulum::damping,
            {.unit = "1/s",
             .meaning = "c: small swings die away as exp(-c t / 2)",
             .minimum = 0.0,
             .maximum = 100.0});
    v.field("radius", &Pendulum::radius,
            {.unit = "m", .meaning = "of the bob", .minimum = 0.01, .maximum = 100.0});
  }
};

/// The equation of motion of one pendulum.
class PendulumModel {
 public:
  struct State {
    double angle = 0.0;  // [rad]
    double rate = 0.0;   // [rad/s]
  };

  explicit PendulumModel(const Pendulum& pendulum) : pendulum_(pendulum) {}

  State start(const Environment& environment, double time) const;
  void advance(State& state, const Environment& environment, double from, double to,
               ImpactLog* log) const;
  int objects() const { return 1; }
  PlanarMotion kinematics(const State& state, const Environment& environment, double time,
                          int object) const;
  int bodies() const { return 1; }
  RigidBody body(const State& state, int index) const;
  ContactProperties contact() const;

 private:
  double angular_acceleration(const State& state, const Environment& environment) const;

  Pendulum pendulum_;
};

}  // namespace ghtrack

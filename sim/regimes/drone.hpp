#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/regimes/free_flight.hpp"
#include "sim/regimes/motion.hpp"

namespace ghtrack {

/// `fly_to: [20, 15]`: go there, slow down in time and stay.
struct FlyTo {
  static constexpr std::string_view kind = "fly_to";
  Vec2 place = Vec2::Zero();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&FlyTo::place, {.unit = "m",
                             .meaning = "go there, slow down in time and stay",
                             .minimum = -1e5,
                             .maximum = 1e5});
  }
};

/// `velocity: [5, 0]`: keep this velocity over the ground.
struct KeepVelocity {
  static constexpr std::string_view kind = "velocity";
  Vec2 velocity = Vec2::Zero();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&KeepVelocity::velocity, {.unit = "m/s",
                                       .meaning = "keep this velocity over the ground",
                                       .minimum = -100.0,
                                       .maximum = 100.0});
  }
};

/// What the pilot wants from an instant on.
struct FlightOrder {
  static constexpr std::string_view about = "what the pilot wants from an instant on";
  double at = 0.0;
  std::variant<FlyTo, KeepVelocity> order;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("at", &FlightOrder::at,
            {.unit = "s",
             .meaning = "time since the scene's start",
             .required = true,
             .minimum = 0.0,
             .maximum = 1e6});
    v.one_of(&FlightOrder::order, {.meaning = "what is wanted then"});
  }
};

class DroneModel;

/// A multirotor in a vertical plane: thrust along its tilted axis, quadratic drag in the wind, and
/// an autopilot whose attitude loop answers as a second-order system,
///   m dv/dt = T n(θ) + m g − ½ ρ C_d A |u| u,   n = (−sin θ, cos θ),  u = v − w
///   d²θ/dt² = ω² (θ_c − θ) − 2 ζ ω dθ/dt.
/// The velocity loop asks for a = (v_c − v)/τ, at most `acceleration`, and knows the drag; θ_c and
/// T follow from it (Mahony, Kumar & Corke 2012). Seen from above, without gravity, the tilt is out
/// of the picture: the horizontal force m g₀ tan θ acts at once, up to that of the largest tilt.
struct Drone {
  static constexpr std::string_view kind = "drone";
  static constexpr std::string_view about =
      "a multirotor on a flight plan: thrust and tilt limits, attitude dynamics, drag in the wind";
  using Model = DroneModel;

  std::string type = "camera-drone";
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  std::vector<FlightOrder> plan;
  double mass = 0.9;
  double radius = 0.2;
  double drag_area = 0.0258;
  double speed = 12.0;
  double acceleration = 4.0;
  double max_tilt_deg = 35.0;
  double max_thrust = 2.0;
  double attitude_rate = 8.0;
  double attitude_damping = 0.8;
  double restitution = 0.2;
  double friction = 0.5;
  double rolling = 0.0;

  static std::span<const Drone> presets();

  void shift(const Vec2& by);
  void hasten(const Vec2& by) { velocity += by; }
  std::string_view unreleasable() const { return ""; }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.preset("type", &Drone::type, Drone::presets(), {.meaning = "typical data of a drone"});
    v.field("position", &Drone::position,
            {.unit = "m",
             .meaning = "of the centre at the start; it hovers there until its first order",
             .required = true,
             .minimum = -1e5,
             .maximum = 1e5});
    v.field("velocity", &Drone::velocity,
            {.unit = "m/s", .meaning = "at the start", .minimum = -100.0, .maximum = 100.0});
    v.field("plan", &Drone::plan, {.meaning = "orders, in the order of time", .max_items = 1000});
    v.field("mass", &Drone::mass,
            {.unit = "kg", .meaning = "with everything on it", .minimum = 0.01, .maximum = 1e3});
    v.field("radius", &Drone::radius,
            {.unit = "m",
             .meaning = "from the centre to the rotor tips",
             .minimum = 0.02,
             .maximum = 10.0});
    v.field("drag_area", &Drone::drag_area,
            {.unit = "m^2",
             .meaning = "drag coefficient times frontal area",
             .minimum = 0.0,
             .maximum = 100.0});
    v.field(
        "speed", &Drone::speed,
        {.unit = "m/s", .meaning = "towards a place of the plan", .above = 0.0, .maximum = 100.0});
    v.field("acceleration", &Drone::acceleration,
            {.unit = "m/s^2",
             .meaning = "the most that the autopilot asks for",
             .minimum = 0.1,
             .maximum = 50.0});
    v.field("max_tilt_deg", &Drone::max_tilt_deg,
            {.unit = "deg",
             .meaning = "the autopilot tilts no farther",
             .minimum = 1.0,
             .maximum = 80.0});
    v.field("max_thrust", &Drone::max_thrust,
            {.unit = "1", .meaning = "largest thrust / weight", .minimum = 1.05, .maximum = 10.0});
    v.field("attitude_rate", &Drone::attitude_rate,
            {.unit = "rad/s",
             .meaning = "natural frequency of the attitude loop",
             .minimum = 1.0,
             .maximum = 50.0});
    v.field("attitude_damping", &Drone::attitude_damping,
            {.unit = "1",
             .meaning = "damping ratio of the attitude loop",
             .minimum = 0.2,
             .maximum = 2.0});
    describe_bounce<Drone>(v);
  }

  template <class Report>
  void check(Report&& report) const {
    if (drag_area > mass) report("drag_area", "must be at most 1 m^2 per kilogram of mass");
    for (std::size_t i = 1; i < plan.size(); ++i) {
      if (plan[i].at > plan[i - 1].at) continue;
      report("plan", "each order must come later than the one before");
      break;
    }
  }
};

/// The equations of motion of one drone.
class DroneModel {
 public:
  using State = FlightState;  // the angle is the tilt, counter-clockwise: flying to the left

  explicit DroneModel(const Drone& drone);

  State start(const Environment& environment, double time) const;
  void advance(State& state, const Environment& environment, double from, double to,
               ImpactLog* log) const;
  int objects() const { return 1; }
  PlanarMotion kinematics(const State& state, const Environment& environment, double time,
                          int object) const;
  int bodies() const { return 1; }
  RigidBody body(const State& state, int index) const;
  ContactProperties contact() const;
  RoundBody round(const Environment& environment) const;
  FlightState* flight(State& state) const { return &state; }
  FlightRate rate(const FlightState& state, const Environment& environment,
                  const SmoothInstant& now) const;
  double stiffness(const FlightState& state, const Environment& environment,
                   const SmoothInstant& now) const;

 private:
  Vec2 wanted_velocity(const FlightState& state, double time) const;
  std::vector<FlightOrder>::const_iterator first_order_after(double time) const;

  Drone drone_;
  double tan_max_tilt_;
  double max_tilt_;  // [rad]
};

}  // namespace ghtrack

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sim/regimes/free_flight.hpp"
#include "sim/regimes/motion.hpp"

namespace ghtrack {

class BalloonModel;

/// A gas balloon in the wind, with V its volume, m envelope and gas, C_a the added-mass
/// coefficient:
///   (m + C_a ρ V) dv/dt = ½ ρ C_d π R² |w − v| (w − v) − (ρ V − m) g + [(1 + C_a) ρ V Dw/Dt]
/// The last term, the pressure field of accelerating air, makes a balloon overshoot a gust
/// (Batchelor 1967, section 6.8); it is off unless asked for. A balloon that expands has the volume
/// V ρ₀/ρ, where ρ₀ is the air's density at its start; burst, it is its envelope alone.
struct Balloon {
  static constexpr std::string_view kind = "balloon";
  static constexpr std::string_view about =
      "a gas balloon: buoyancy, added mass, drag relative to the wind";
  using Model = BalloonModel;

  std::string type = "latex-11-inch";
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double radius = 0.14;
  double envelope_mass = 0.0032;
  double gas_density = 0.1664;
  double drag = 0.47;
  double added_mass = 0.5;
  bool fluid_acceleration = false;
  bool expands = false;
  std::optional<double> burst_radius;
  double fall_drag_area = 0.01;
  double restitution = 0.6;
  double friction = 0.4;
  double rolling = 0.0;

  static std::span<const Balloon> presets();

  void shift(const Vec2& by) { position += by; }
  void hasten(const Vec2& by) { velocity += by; }
  std::string_view unreleasable() const { return ""; }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.preset("type", &Balloon::type, Balloon::presets(),
             {.meaning = "published data of a balloon"});
    v.field("position", &Balloon::position,
            {.unit = "m",
             .meaning = "of the centre at the start",
             .required = true,
             .minimum = -1e5,
             .maximum = 1e5});
    v.field("velocity", &Balloon::velocity,
            {.unit = "m/s", .meaning = "at the start", .minimum = -150.0, .maximum = 150.0});
    v.field("radius", &Balloon::radius,
            {.unit = "m", .meaning = "of the sphere", .minimum = 0.02, .maximum = 20.0});
    v.field(
        "envelope_mass", &Balloon::envelope_mass,
        {.unit = "kg", .meaning = "of envelope, string and load", .above = 0.0, .maximum = 1e5});
    v.field("gas_density", &Balloon::gas_density,
            {.unit = "kg/m^3",
             .meaning = "of the gas inside: 0.1664 helium, 0.0838 hydrogen",
             .minimum = 0.0,
             .maximum = 10.0});
    v.field("drag", &Balloon::drag,
            {.unit = "1", .meaning = "drag coefficient", .minimum = 0.0, .maximum = 10.0});
    v.field("added_mass", &Balloon::added_mass,
            {.unit = "1",
             .meaning = "mass of air moved along / mass of displaced air, 0.5 for a sphere",
             .minimum = 0.0,
             .maximum = 2.0});
    v.field("fluid_acceleration", &Balloon::fluid_acceleration,
            {.meaning = "include the pressure field of accelerating air"});
    v.field("expands", &Balloon::expands,
            {.meaning = "grows as the air around it thins: the gas keeps the air's pressure and "
                        "temperature. Others touch it as it was at the start"});
    v.field("burst_radius", &Balloon::burst_radius,
            {.unit = "m",
             .meaning = "at which it bursts; the envelope falls then. Left out: never",
             .above = 0.0,
             .maximum = 100.0});
    v.field("fall_drag_area", &Balloon::fall_drag_area,
            {.unit = "m^2",
             .meaning = "drag coefficient times area of what falls: rags, load and parachute",
             .minimum = 0.0,
             .maximum = 1000.0});
    describe_bounce<Balloon>(v);
  }

  template <class Report>
  void check(Report&& report) const {
    const double volume = 4.19 * radius * radius * radius;
    if (envelope_mass + gas_density * volume < 0.02 * volume) {
      report("envelope_mass",
             "too light for its size: 0.02 kg per cubic metre, gas included, is the least");
    }
    if (burst_radius && !expands) report("burst_radius", "only a balloon that `expands` bursts");
    if (burst_radius && *burst_radius <= radius) {
      report("burst_radius", "must be greater than `radius`");
    }
    if (fall_drag_area > 1000.0 * envelope_mass) {
      report("fall_drag_area", "must be at most 1000 m^2 per kilogram of envelope");
    }
  }
};

/// The equations of motion of one balloon.
class BalloonModel {
 public:
  using State = FlightState;

  explicit BalloonModel(const Balloon& balloon);

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
  /// What it is at a height.
  struct Form {
    double displaced = 0.0;       // mass of the air that it displaces [kg]
    double inertia = 0.0;         // with the air that moves along [kg]
    double drag_per_speed = 0.0;  // k of −k |u| u [1/m]
  };
  Form form(const FlightState& state, const Environment& environment) const;
  double growth(const FlightState& state, const Environment& environment) const;

  Balloon balloon_;
  double volume_;  // [m³]
  double mass_;    // envelope and gas [kg]
};

}  // namespace ghtrack

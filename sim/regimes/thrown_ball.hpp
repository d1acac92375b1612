#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "sim/motion_law.hpp"
#include "sim/regimes/free_flight.hpp"
#include "sim/regimes/juggling.hpp"
#include "sim/regimes/motion.hpp"

namespace ghtrack {

/// Lift coefficient as a function of the spin parameter S = r |ω| / |u|.
enum class LiftModel {
  kNone,
  kNathan2016,  // 1.120 S / (0.583 + 2.333 S)
  kNathanOld,   // S / (0.4 + 2.32 S)
  kStepanek,    // 1 / (2 + 1/S), tennis (Štěpánek 1988)
};

constexpr std::array<std::pair<std::string_view, LiftModel>, 4> enum_names(LiftModel) {
  return {{{"none", LiftModel::kNone},
           {"nathan-2016", LiftModel::kNathan2016},
           {"nathan-old", LiftModel::kNathanOld},
           {"stepanek", LiftModel::kStepanek}}};
}

/// The drop of drag where the boundary layer turns turbulent: from `drag` below Reynolds number
/// `from` linearly to `drag` of this struct above `to`.
struct DragCrisis {
  double from = 1.0e5;
  double to = 1.35e5;
  double drag = 0.22;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field(
        "from", &DragCrisis::from,
        {.unit = "1", .meaning = "Reynolds number where it begins", .above = 0.0, .maximum = 1e8});
    v.field(
        "to", &DragCrisis::to,
        {.unit = "1", .meaning = "Reynolds number where it ends", .above = 0.0, .maximum = 1e8});
    v.field(
        "drag", &DragCrisis::drag,
        {.unit = "1", .meaning = "drag coefficient beyond it", .minimum = 0.0, .maximum = 10.0});
  }

  template <class Report>
  void check(Report&& report) const {
    if (!(to > from)) report("to", "must be greater than `from`");
  }
};

class BallModel;

/// A ball in flight: gravity, drag along and Magnus lift across its velocity relative to the air,
///   a = g − K C_d |u| u + sign(ω) K C_L(S) |u| R90(u),   u = v − w,  K = ρ π r² / 2m,
/// with spin that decays as dω/dt = −ω |u| / (τ × 44.704 m/s) (Nathan 2016).
struct ThrownBall {
  static constexpr std::string_view kind = "ball";
  static constexpr std::string_view about =
      "a thrown ball: gravity, drag, Magnus lift, bounces with Coulomb friction";
  using Model = BallModel;

  std::string type = "baseball";
  Vec2 position = Vec2::Zero();
  std::optional<Vec2> velocity;
  std::optional<double> speed;
  std::optional<double> angle_deg;
  std::optional<double> spin;
  std::optional<double> spin_rpm;
  double mass = 0.145;
  double radius = 0.0366;
  double drag = 0.35;
  std::optional<DragCrisis> drag_crisis;
  LiftModel lift = LiftModel::kNathan2016;
  double spin_decay = 30.0;
  double inertia = 0.4;
  double restitution = 0.55;
  double friction = 0.4;
  double rolling = 0.0;
  bool buoyancy = false;
  std::optional<Juggling> juggle;

  static std::span<const ThrownBall> presets();

  /// With which it is thrown, unless it is juggled [m/s].
  Vec2 initial_velocity() const;

  void shift(const Vec2& by);
  void hasten(const Vec2& by);
  /// A parabola, where there is neither air nor anything to bounce on.
  std::optional<MotionLaw> law(const EnvironmentConfig& environment) const;
  std::string_view unreleasable() const {
    return juggle ? "the juggler's hands throw this ball" : "";
  }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.preset("type", &ThrownBall::type, ThrownBall::presets(),
             {.meaning = "published data of a ball"});
    v.field("position", &ThrownBall::position,
            {.unit = "m",
             .meaning = "of the centre at the start",
             .required = true,
             .minimum = -1e5,
             .maximum = 1e5});
    v.field("velocity", &ThrownBall::velocity,
            {.unit = "m/s",
             .meaning = "at the start; or give speed and angle_deg",
             .minimum = -400.0,
             .maximum = 400.0});
    v.field("speed", &ThrownBall::speed,
            {.unit = "m/s",
             .meaning = "at the start, instead of velocity",
             .minimum = 0.0,
             .maximum = 400.0});
    v.field("angle_deg", &ThrownBall::angle_deg,
            {.unit = "deg",
             .meaning = "direction of speed above the x axis, 0 if left out",
             .minimum = -360.0,
             .maximum = 360.0});
    v.field("spin", &ThrownBall::spin,
            {.unit = "rad/s",
             .meaning = "counter-clockwise; backspin for a ball that flies to the right",
             .minimum = -3000.0,
             .maximum = 3000.0});
    v.field("spin_rpm", &ThrownBall::spin_rpm,
            {.unit = "rpm",
             .meaning = "the same in turns per minute, instead of spin",
             .minimum = -28000.0,
             .maximum = 28000.0});
    v.field("mass", &ThrownBall::mass,
            {.unit = "kg", .meaning = "of the ball", .minimum = 1e-4, .maximum = 1e4});
    v.field("radius", &ThrownBall::radius,
            {.unit = "m", .meaning = "of the ball", .minimum = 0.005, .maximum = 10.0});
    v.field("drag", &ThrownBall::drag,
            {.unit = "1",
             .meaning = "drag coefficient, below the drag crisis if there is one",
             .minimum = 0.0,
             .maximum = 10.0});
    v.field("drag_crisis", &ThrownBall::drag_crisis,
            {.meaning = "fall of the drag coefficient with Reynolds number"});
    v.field("lift", &ThrownBall::lift, {.meaning = "lift coefficient as a function of spin"});
    v.field("spin_decay", &ThrownBall::spin_decay,
            {.unit = "s",
             .meaning = "time constant of the spin at 44.704 m/s in air of 1.2 kg/m^3; 0: no decay",
             .minimum = 0.0,
             .maximum = 1e6});
    v.field("inertia", &ThrownBall::inertia,
            {.unit = "1",
             .meaning = "moment of inertia / (mass radius^2): 0.4 solid, 0.667 thin shell",
             .above = 0.0,
             .maximum = 1.0});
    describe_bounce<ThrownBall>(v);
    v.field(
        "buoyancy", &ThrownBall::buoyancy,
        {.meaning = "the air lifts it by what it displaces, and half as much air moves along: for "
                    "light balls, such as beach balls"});
    v.field("juggle", &ThrownBall::juggle,
            {.meaning = "the hands of a juggler, instead of a velocity; left out: thrown once"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (velocity && (speed || angle_deg)) {
      report("velocity", "give either velocity or speed and angle_deg, not both");
    }
    if (juggle && (velocity || speed)) {
      report("juggle", "the hands give the velocity: leave out velocity and speed");
    }
    if (angle_deg && !speed) report("angle_deg", "an angle needs a speed");
    if (spin_decay > 0.0 && spin_decay < 0.1) report("spin_decay", "must be 0 or at least 0.1 s");
    if (mass < 4.0 * radius * radius * radius) {
      report("mass", "the ball must not be lighter than air: at least 1 kg per cubic metre");
    }
    if (juggle && !((juggle->to - position).norm() <= 400.0 * juggle->flight)) {
      report("juggle", "the hands are too far apart: the ball would have to fly at over 400 m/s");
    }
    if (spin && spin_rpm) report("spin_rpm", "give either spin or spin_rpm, not both");
  }
};

/// The equations of motion of one ball.
class BallModel {
 public:
  struct State {
    FlightState flight;
    double thrown = 0.0;         // when the first time [s]
    int phase = 0;               // of juggling
    std::optional<Carry> carry;  // while a hand holds it
  };

  explicit BallModel(const ThrownBall& ball);

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
  /// A hand does not give way.
  FlightState* flight(State& state) const { return state.carry ? nullptr : &state.flight; }
  FlightRate rate(const FlightState& state, const Environment& environment,
                  const SmoothInstant& now) const;
  double stiffness(const FlightState& state, const Environment& environment,
                   const SmoothInstant& now) const;

 private:
  void begin_next_phase(State& state, const JugglingPattern& pattern) const;
  double drag_coefficient(double density, double viscosity, double speed) const;
  double volume() const;  // [m³]

  ThrownBall ball_;
  double spin_;          // with which it is thrown [rad/s]
  double area_to_mass_;  // π r² / 2m [m²/kg]
};

}  // namespace ghtrack

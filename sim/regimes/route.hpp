#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/motion_law.hpp"
#include "sim/process_noise.hpp"
#include "sim/regimes/motion.hpp"
#include "sim/regimes/rail_line.hpp"

namespace ghtrack {

/// `to: [200, 0]`: straight to a place.
struct GoTo {
  static constexpr std::string_view kind = "to";
  Vec2 place = Vec2::Zero();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&GoTo::place,
             {.unit = "m", .meaning = "straight to this place", .minimum = -1e6, .maximum = 1e6});
  }
};

/// `hold: 30`: straight on for a time.
struct HoldCourse {
  static constexpr std::string_view kind = "hold";
  double duration = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&HoldCourse::duration,
             {.unit = "s",
              .meaning = "straight on for so long, changes of speed included",
              .above = 0.0,
              .maximum = 1e6});
  }
};

/// A coordinated turn: an arc at constant speed.
struct Turn {
  static constexpr std::string_view kind = "turn";
  static constexpr std::string_view about =
      "an arc at constant speed, to the left where the angle is positive";
  double angle_deg = 90.0;
  std::optional<double> radius = std::nullopt;
  std::optional<double> rate_deg = std::nullopt;
  std::optional<double> acceleration = std::nullopt;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("angle_deg", &Turn::angle_deg,
            {.unit = "deg",
             .meaning = "turned through; negative: to the right",
             .required = true,
             .minimum = -36000.0,
             .maximum = 36000.0});
    v.field("radius", &Turn::radius,
            {.unit = "m", .meaning = "of the arc", .above = 0.0, .maximum = 1e6});
    v.field("rate_deg", &Turn::rate_deg,
            {.unit = "deg/s", .meaning = "instead of radius", .above = 0.0, .maximum = 360.0});
    v.field("acceleration", &Turn::acceleration,
            {.unit = "m/s^2",
             .meaning = "across the path, instead of radius",
             .above = 0.0,
             .maximum = 1e3});
  }

  template <class Report>
  void check(Report&& report) const {
    if (angle_deg == 0.0) report("angle_deg", "must not be 0");
    if (radius.has_value() + rate_deg.has_value() + acceleration.has_value() != 1) {
      report("radius", "a turn needs exactly one of radius, rate_deg and acceleration");
    }
  }
};

/// `wait: 20`: it stands.
struct Wait {
  static constexpr std::string_view kind = "wait";
  double duration = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&Wait::duration,
             {.unit = "s", .meaning = "stands for so long", .above = 0.0, .maximum = 1e6});
  }
};

using RouteCourse = std::variant<GoTo, Straight, HoldCourse, Turn, Wait>;

/// One leg of a route.
struct RouteLeg {
  static constexpr std::string_view about = "one leg of a route, from the end of the one before";
  std::optional<double> speed = std::nullopt;
  std::optional<double> turn_radius = std::nullopt;
  RouteCourse course;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("speed", &RouteLeg::speed,
            {.unit = "m/s",
             .meaning = "along the leg; left out: as before. It slows down before a slower leg and "
                        "hastens after it; a turn is driven at its own speed throughout",
             .above = 0.0,
             .maximum = 1e4});
    v.field("turn_radius", &RouteLeg::turn_radius,
            {.unit = "m",
             .meaning = "of the turn from this leg into the next, where that goes to a place; left "
                        "out: the route's; 0: at once",
             .minimum = 0.0,
             .maximum = 1e6});
    v.one_of(&RouteLeg::course, {.meaning = "where it leads"});
  }
};

class RouteModel;

/// Prescribed motion of a walker, a car, a ship or an aircraft in the horizontal plane, or of
/// anything else that nothing but its own will moves: straights and arcs, driven at given speeds,
/// changed at a constant acceleration along the path. Position, velocity and acceleration are exact
/// at any instant: where a leg begins is known in closed form.
struct Route {
  static constexpr std::string_view kind = "route";
  static constexpr std::string_view about =
      "prescribed motion: places, turns and speeds of a walker, car, ship or aircraft";
  using Model = RouteModel;

  std::string type = "walker";
  Vec2 position = Vec2::Zero();
  double heading_deg = 0.0;
  double speed = 1.4;
  std::vector<RouteLeg> legs;
  bool stops = false;
  double acceleration = 1.0;
  double turn_radius = 0.5;
  ProcessNoiseConfig process_noise;
  double length = 0.5;
  double width = 0.5;

  static std::span<const Route> presets();

  void shift(const Vec2& by);
  void hasten(const Vec2& by);
  /// That of its process noise, along x and y; not of turns, whose noise is not linear.
  std::optional<MotionLaw> law(const EnvironmentConfig& environment) const;
  std::string_view unreleasable() const { return "nothing can release what follows a route"; }

  /// What cannot be driven, and why.
  struct Flaw {
    std::string key;
    std::string message;
  };
  std::vector<Flaw> flaws() const;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.preset("type", &Route::type, Route::presets(),
             {.meaning = "typical size, speed and agility"});
    v.field("position", &Route::position,
            {.unit = "m", .meaning = "at the start", .minimum = -1e6, .maximum = 1e6});
    v.field("heading_deg", &Route::heading_deg,
            {.unit = "deg",
             .meaning = "at the start, where the first leg does not go to a place",
             .minimum = -360.0,
             .maximum = 360.0});
    v.field("speed", &Route::speed,
            {.unit = "m/s",
             .meaning = "at the start, and of the legs until one names another",
             .minimum = 0.0,
             .maximum = 1e4});
    v.field("legs", &Route::legs,
            {.meaning = "one after the other; beyond the last it keeps course and speed",
             .max_items = 10'000});
    v.field("stops", &Route::stops, {.meaning = "stands at the end of the last leg"});
    v.field("acceleration", &Route::acceleration,
            {.unit = "m/s^2",
             .meaning = "along the path, with which it changes its speed",
             .above = 0.0,
             .maximum = 1e4});
    v.field("turn_radius", &Route::turn_radius,
            {.unit = "m",
             .meaning = "of the turn from one leg into the next; 0: at once",
             .minimum = 0.0,
             .maximum = 1e6});
    v.field("process_noise", &Route::process_noise,
            {.meaning = "how it strays from all this, otherwise in every run"});
    v.field("length", &Route::length,
            {.unit = "m", .meaning = "of its outline", .minimum = 0.01, .maximum = 1000.0});
    v.field("width", &Route::width,
            {.unit = "m",
             .meaning = "of its outline; as much as the length: a disc",
             .minimum = 0.01,
             .maximum = 1000.0});
  }

  template <class Report>
  void check(Report&& report) const {
    for (const Flaw& flaw : flaws()) report(flaw.key, flaw.message);
  }
};

/// A part of the route on which curvature and acceleration along the path are constant.
struct Stretch {
  double begin = 0.0;            // since the start [s]
  Vec2 position = Vec2::Zero();  // there [m]
  double heading = 0.0;          // there [rad]
  double curvature = 0.0;        // positive to the left [1/m]
  double speed = 0.0;            // there [m/s]
  double acceleration = 0.0;     // [m/s²]
};

/// The motion along a route.
class RouteModel {
 public:
  struct State {
    double began = 0.0;  // [s]
    double time = 0.0;   // [s]
    ProcessNoise::State noise;
    Vec2 position = Vec2::Zero();  // of what turns at a noisy rate; otherwise unused [m]
  };

  explicit RouteModel(const Route& route, const RandomSource& source = {});

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
  /// How it moves along its path.
  struct Travel {
    double heading = 0.0;       // [rad]
    double turn_rate = 0.0;     // [rad/s]
    double speed = 0.0;         // [m/s]
    double acceleration = 0.0;  // along the path [m/s²]
  };
  std::size_t stretch_at(double elapsed) const;
  Travel travel(const Stretch& stretch, const ProcessNoise::State& noise, double elapsed) const;
  Vec2 way(const Stretch& stretch, const ProcessNoise::State& noise, double from, double to) const;
  Vec2 prescribed_position(const Stretch& stretch, double elapsed) const;
  PlanarMotion motion(const State& state) const;

  ContactProperties contact_;
  std::vector<Stretch> stretches_;  // the last has no end
  ProcessNoise noise_;
};

}  // namespace ghtrack

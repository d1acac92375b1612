#pragma once

#include <Eigen/Core>
#include <string_view>
#include <variant>

#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gains/rules.hpp"
#include "tracker/filters/implied_noise.hpp"

namespace ghtrack {

/// State of one object on one axis or in the plane: x, y, v_x, v_y, then what else the motion has,
/// SI units.
using MotionState = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using MotionCovariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// What a component of a state means. Models that share a component can exchange it.
enum class StateComponent { kX, kY, kVx, kVy, kAx, kAy, kTurnRate, kDrag };

// How targets move. Each motion offers
//   components      what its state holds, in order
//   order           highest derivative of the position in it
//   moved(x, dt)    the state dt seconds later, without noise
//   noise(x, dt)    covariance of what noise adds meanwhile
//   first_guess, first_sigma   of the components after the velocity, at first sight

/// Rest, constant velocity or acceleration: the motion of the linear filters, and their noise. On
/// one axis or two, which the state tells.
struct PolynomialMotion {
  int order = 1;  // 0, 1 or 2
  ProcessModel process_model = ProcessModel::kWhiteNoise;
  double process_intensity = 1.0;  // see process_noise()
  double renewal = 1.0;            // see process_noise() [s]
  NoiseDensities implied = {};     // by given gains, beside it
  double initial_acceleration = 0.0;

  MotionState moved(const MotionState& x, double dt) const;
  MotionCovariance noise(const MotionState& x, double dt) const;
};

/// A turn of constant speed and rate ω (Bar-Shalom, Li & Kirubarajan 2001, 11.7):
///   x + (v_x sin ωt − v_y (1 − cos ωt)) / ω,   v_x cos ωt − v_y sin ωt, …
struct CoordinatedTurn {
  static constexpr std::string_view kind = "coordinated-turn";
  static constexpr std::string_view about = "Turns at a constant rate, which is estimated.";

  double spectral_density = 1.0;   // [m²/s³]
  double turn_density = 0.02;      // [rad²/s³]
  double initial_turn_rate = 0.5;  // 1 sigma [rad/s]

  MotionState moved(const MotionState& x, double dt) const;
  MotionCovariance noise(const MotionState& x, double dt) const;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("spectral_density", &CoordinatedTurn::spectral_density,
            {.unit = "m²/s³", .meaning = "power of the noise in the acceleration", .minimum = 0.0});
    v.field(
        "turn_density", &CoordinatedTurn::turn_density,
        {.unit = "rad²/s³", .meaning = "power of the noise in the turn's rate", .minimum = 0.0});
    v.field("initial_turn_rate", &CoordinatedTurn::initial_turn_rate,
            {.unit = "rad/s",
             .meaning = "1-sigma rate of turn of a target at first sight",
             .above = 0.0});
  }
};

/// A flight under gravity and drag: a = −g e_y − c |v| v, with c estimated.
struct Ballistic {
  static constexpr std::string_view kind = "ballistic";
  static constexpr std::string_view about =
      "Flies under gravity and drag proportional to the square of the speed, which is estimated.";

  double gravity = 9.80665;
  double spectral_density = 0.5;  // [m²/s³]
  double drag = 0.006;            // c at first sight [1/m]: a baseball's
  double drag_sigma = 0.004;      // 1 sigma [1/m]
  double drag_density = 1e-7;     // [1/m²s]

  MotionState moved(const MotionState& x, double dt) const;
  MotionCovariance noise(const MotionState& x, double dt) const;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("gravity", &Ballistic::gravity,
            {.unit = "m/s²", .meaning = "downwards", .minimum = -1e3, .maximum = 1e3});
    v.field("spectral_density", &Ballistic::spectral_density,
            {.unit = "m²/s³", .meaning = "power of the noise in the acceleration", .minimum = 0.0});
    v.field("drag", &Ballistic::drag,
            {.unit = "1/m",
             .meaning = "deceleration by drag over the square of the speed, at first sight",
             .minimum = 0.0,
             .maximum = 10.0});
    v.field("drag_sigma", &Ballistic::drag_sigma,
            {.unit = "1/m", .meaning = "1-sigma error of it", .minimum = 0.0, .maximum = 10.0});
    v.field("drag_density", &Ballistic::drag_density,
            {.unit = "1/(m²s)", .meaning = "power of the noise in it", .minimum = 0.0});
  }
};

/// How a target moves. Add yours here.
using TargetMotion = std::variant<PolynomialMotion, CoordinatedTurn, Ballistic>;

/// Does the motion need a plane?
bool needs_plane(const TargetMotion& motion);

/// Number of components of a state on this many axes, and what they are.
int states_of(const TargetMotion& motion, int axes);
StateComponent component_of(const TargetMotion& motion, int i, int axes);

/// Mean and 1-sigma error of the components after the velocity at first sight.
struct FirstGuess {
  double mean = 0.0;
  double sigma = 0.0;
};
FirstGuess first_guess_of(const TargetMotion& motion, int i);

MotionState moved(const TargetMotion& motion, const MotionState& x, double dt);
MotionCovariance noise(const TargetMotion& motion, const MotionState& x, double dt);

}  // namespace ghtrack

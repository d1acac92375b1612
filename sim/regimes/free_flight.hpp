#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/regimes/motion.hpp"
#include "sim/surface.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// State of a round body in the air or on a surface.
struct FlightState {
  Vec2 position = Vec2::Zero();  // of the centre [m]
  Vec2 velocity = Vec2::Zero();  // [m/s]
  double angle = 0.0;            // [rad]
  double spin = 0.0;             // [rad/s]
  int support = -1;              // the surface it rests or rolls on; −1: none
};

/// What the forces of flight make of a state.
struct FlightRate {
  Vec2 acceleration = Vec2::Zero();  // [m/s²]
  double spin = 0.0;                 // [rad/s²]
};

/// What matters of a round body when it touches something.
struct RoundBody {
  double radius;       // [m]
  double inertia;      // moment of inertia / (mass × radius²)
  double restitution;  // where the surface names none
  double friction;     // where the surface names none
};

/// The rates of a body that a surface supports: the normal part of the acceleration is taken up,
/// Coulomb friction acts along the surface until the body rolls.
FlightRate supported_rate(const FlightState& state, const FlightRate& free, const RoundBody& body,
                          const Surface& surface);

/// Whether the surface still supports a body that `free` accelerates.
bool supports(const Surface& surface, const FlightState& state, const FlightRate& free);

/// Impact law: restitution along the normal, Coulomb friction along the surface, limited by the
/// impulse after which the contact point does not slip (Cross 2002):
///   v_n' = −e v_n,  J_t = min(μ (1 + e) |v_n|, |v_t| / (1 + 1/β)),  v_t the slip of the rim.
/// A bounce too slow to be seen makes the surface a support.
void bounce(FlightState& state, const RoundBody& body, const std::vector<Surface>& surfaces,
            std::size_t surface);

/// What a sensor may see of a body with these rates of free flight.
PlanarMotion flight_kinematics(const FlightState& state, const FlightRate& free,
                               const RoundBody& body, const std::vector<Surface>& surfaces);

/// Takes over what a collision has made of the body.
void adopt_flight(FlightState& state, const RigidBody& body);

/// One Runge–Kutta step of fourth order. Rates: FlightRate(const FlightState&, double time).
template <class Rates>
FlightState runge_kutta(const FlightState& state, double time, double step, const Rates& rates) {
  const auto moved = [&state](const Vec2& velocity, const FlightRate& rate, double h) {
    FlightState next = state;
    next.position += h * velocity;
    next.velocity += h * rate.acceleration;
    next.spin += h * rate.spin;
    return next;
  };
  const FlightRate k1 = rates(state, time);
  const FlightState s2 = moved(state.velocity, k1, step / 2.0);
  const FlightRate k2 = rates(s2, time + step / 2.0);
  const FlightState s3 = moved(s2.velocity, k2, step / 2.0);
  const FlightRate k3 = rates(s3, time + step / 2.0);
  const FlightState s4 = moved(s3.velocity, k3, step);
  const FlightRate k4 = rates(s4, time + step);

  FlightState next = state;
  const double sixth = step / 6.0;
  next.position += sixth * (state.velocity + 2.0 * s2.velocity + 2.0 * s3.velocity + s4.velocity);
  next.velocity +=
      sixth * (k1.acceleration + 2.0 * k2.acceleration + 2.0 * k3.acceleration + k4.acceleration);
  next.spin += sixth * (k1.spin + 2.0 * k2.spin + 2.0 * k3.spin + k4.spin);
  next.angle += sixth * (state.spin + 2.0 * s2.spin + 2.0 * s3.spin + s4.spin);
  return next;
}

/// The surface that the body hits first on its way from `before` to `after`, and a bracket of the
/// impact's time, as fractions of the step. The path between is taken as a cubic.
struct Approach {
  int surface = -1;
  double clear = 0.0;     // still apart here
  double touching = 1.0;  // overlapping and approaching here
};
Approach first_approach(const FlightState& before, const FlightState& after, double step,
                        const RoundBody& body, const std::vector<Surface>& surfaces);

/// Flies, bounces and rolls over [from, to].
template <class Rates>
void fly(FlightState& state, double from, double to, const RoundBody& body,
         const std::vector<Surface>& surfaces, const Rates& rates) {
  // A ball wedged between two surfaces could bounce for ever within a step: after this many
  // impacts it stays where it is until the step's end.
  constexpr int kMaxImpacts = 100;
  double time = from;
  for (int impact = 0; impact <= kMaxImpacts && time < to; ++impact) {
    if (state.support >= 0) {
      const Surface& surface = surfaces[static_cast<std::size_t>(state.support)];
      if (!supports(surface, state, rates(state, time))) state.support = -1;
    }
    const auto rates_here = [&](const FlightState& s, double t) {
      const FlightRate free = rates(s, t);
      if (s.support < 0) return free;
      return supported_rate(s, free, body, surfaces[static_cast<std::size_t>(s.support)]);
    };
    const double step = to - time;
    FlightState next = runge_kutta(state, time, step, rates_here);
    const Approach approach = first_approach(state, next, step, body, surfaces);
    if (approach.surface < 0) {
      state = next;
      return;
    }
    const auto index = static_cast<std::size_t>(approach.surface);
    double clear = approach.clear * step;
    double touching = approach.touching * step;
    for (int i = 0; i < 60 && touching - clear > 1e-12; ++i) {
      const double middle = 0.5 * (clear + touching);
      const FlightState trial = runge_kutta(state, time, middle, rates_here);
      const double gap = surfaces[index].contact(trial.position).distance - body.radius;
      (gap > 0.0 ? clear : touching) = middle;
    }
    state = runge_kutta(state, time, touching, rates_here);
    time += touching;
    bounce(state, body, surfaces, index);
  }
}

/// The same for forces that may be stiff: `stiffness(state, time)` is the rate [1/s] at which they
/// change with the motion, and no step is longer than half its inverse. As drag is quadratic the
/// rate falls with the speed through the air, so even a balloon in a hurricane needs few steps.
template <class Rates, class Stiffness>
void fly_stiffly(FlightState& state, double from, double to, const RoundBody& body,
                 const std::vector<Surface>& surfaces, const Rates& rates,
                 const Stiffness& stiffness) {
  for (double time = from; time < to;) {
    const double change = stiffness(state, time) * (to - time);
    const double end = change <= 0.5 ? to : time + (to - time) * 0.5 / change;
    fly(state, time, end, body, surfaces, rates);
    time = end;
  }
}

}  // namespace ghtrack

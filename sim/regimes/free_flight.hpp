#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sim/environment.hpp"
#include "sim/portable_math.hpp"
#include "sim/regimes/motion.hpp"
#include "sim/surface.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// State of a round body in the air or on one or two surfaces.
struct FlightState {
  Vec2 position = Vec2::Zero();  // of the centre [m]
  Vec2 velocity = Vec2::Zero();  // [m/s]
  double angle = 0.0;            // [rad]
  double spin = 0.0;             // [rad/s]
  int support = -1;              // the surface it rests or rolls on; −1: none
  int second_support = -1;       // another one, as in a corner
  bool leans = false;            // on other bodies, which accelerate it together with all else by
  Vec2 leaning_acceleration = Vec2::Zero();  // [m/s²]
  bool is_burst = false;                     // of a balloon
};

/// What the forces of flight make of a state.
struct FlightRate {
  Vec2 acceleration = Vec2::Zero();  // [m/s²]
  double spin = 0.0;                 // [rad/s²]
};

/// What matters of a round body when it touches something.
struct RoundBody {
  double radius;       // [m]
  double inertia;      // moment of inertia / (mass × radius²), for the mass below
  double restitution;  // where the surface names none
  double friction;     // where the surface names none
  double rolling;      // the same: coefficient of rolling resistance
  double mass;         // that answers to a push: air that is moved along counts [kg]
};

/// The one threshold of bouncing: where forces press a body back onto what it has just hit, be that
/// ground, wall or another body, an impact after which it would part at less than this [m/s] does
/// not bounce at all. Where nothing presses them together, bodies bounce at any speed.
inline constexpr double kLeastBounce = 0.01;

/// Two bodies closer than this touch [m].
inline constexpr double kTouching = 1e-9;

/// The senses in which a body on surfaces turns and slips during a step: so long its equations of
/// motion are smooth.
struct Senses {
  double turning = 0.0;             // sign of the spin; 0: it does not turn, and may be held so
  std::array<double, 2> slip = {};  // signs of its slip on the supports; 0: sticks, or rolls
};
Senses senses_of(const FlightState& state, const RoundBody& body,
                 const std::vector<Surface>& surfaces);

/// The rates of a body that surfaces support: the normal part of the acceleration is taken up,
/// Coulomb friction acts along the surface until the body rolls, and rolling resistance c holds
/// against its turning with a couple of up to c × radius × force.
FlightRate supported_rate(const FlightState& state, const FlightRate& free, const RoundBody& body,
                          const std::vector<Surface>& surfaces, const Senses& senses);

/// Rests a body on the surfaces that it touches and does not leave or approach.
void find_supports(FlightState& state, const RoundBody& body, const std::vector<Surface>& surfaces);

/// Forgets the supports that the velocity leaves or from which the forces draw the body, and those
/// that it does not touch because something has pushed it off.
void leave_supports(FlightState& state, const FlightRate& free, const RoundBody& body,
                    const std::vector<Surface>& surfaces);

/// Takes out what a step's error has left of motion into the supports, and of turning back after a
/// rolling body has come to rest.
/// @returns whether anything was taken out of the motion
bool settle_on_supports(FlightState& state, const RoundBody& body,
                        const std::vector<Surface>& surfaces, double turning);

/// Whether a supported body hardly moves; `rest` then brings it to a stand if the forces let it,
/// though it may go on to spin.
bool is_nearly_at_rest(const FlightState& state);

/// The same body without a velocity; it spins on if it turns fast, since nothing may be rough.
FlightState standing(FlightState state, const RoundBody& body);

/// See is_nearly_at_rest().
void rest(FlightState& state, const FlightRate& free, const RoundBody& body,
          const std::vector<Surface>& surfaces);

/// So long a step of a body that supports hold may be: on a curve it turns by little [s].
double longest_step_on_supports(const FlightState& state, const std::vector<Surface>& surfaces);

/// Takes back what a step's error has added to the kinetic energy: surfaces do no work. What other
/// forces do is taken by their values at both ends.
void keep_energy(const FlightState& before, FlightState& after, const FlightRate& free_before,
                 const FlightRate& free_after, const RoundBody& body);

/// Whether the equations of motion change between two states on the same supports: a rolling body
/// comes to rest, a sliding one comes to roll or to slide the other way, as where a slope draws it
/// on while its rim is slower, or it passes the end of a face.
bool changes_on_supports(const FlightState& before, const FlightState& after, const RoundBody& body,
                         const std::vector<Surface>& surfaces);

/// Impact law: restitution along the normal, Coulomb friction along the surface, limited by the
/// impulse after which the contact point does not slip (Cross 2002):
///   v_n' = −e v_n,  J_t = min(μ (1 + e) |v_n|, |v_t| / (1 + 1/β)),  v_t the slip of the rim.
/// A bounce below kLeastBounce, where `free` forces press the body back, makes the surface a
/// support. What else it rests on is struck in turn.
/// @returns the impulse [N s]
Vec2 bounce(FlightState& state, const FlightRate& free, const RoundBody& body,
            const std::vector<Surface>& surfaces, std::size_t surface);

/// Where a body hits to and fro in a narrow wedge without end: all that it touches takes up what is
/// left of its motion, at once and without restitution.
/// @returns the impulse [N s]
Vec2 stop_wedged(FlightState& state, const RoundBody& body, const std::vector<Surface>& surfaces);

/// What a sensor may see of a body with these rates of free flight.
PlanarMotion flight_kinematics(const FlightState& state, const FlightRate& free,
                               const RoundBody& body, const std::vector<Surface>& surfaces);

/// The body as others see it.
RigidBody body_in_flight(const FlightState& state);

/// An instant, and the time around it during which the wind is smooth.
struct SmoothInstant {
  double time = 0.0;                                        // [s]
  double earliest = 0.0;                                    // [s]
  double latest = std::numeric_limits<double>::infinity();  // [s]
};

/// What the model of a round body that gives way offers beside what IsMotionModel asks for.
///   round(environment)                  what matters when it touches something
///   flight(state)                       its state; null while it is held and does not give way
///   rate(flight, environment, now)      what the forces of flight make of a state
///   stiffness(flight, environment, now) the rate at which these change with the motion [1/s]
template <class M>
concept IsRoundModel = requires(const M& model, typename M::State& state, const FlightState& flight,
                                const Environment& environment, const SmoothInstant& now) {
  { model.round(environment) } -> std::same_as<RoundBody>;
  { model.flight(state) } -> std::same_as<FlightState*>;
  { model.rate(flight, environment, now) } -> std::same_as<FlightRate>;
  { model.stiffness(flight, environment, now) } -> std::same_as<double>;
};

/// The keys by which a regime of round bodies says how these bounce.
template <class RoundRegime, class Visitor>
void describe_bounce(Visitor& v) {
  v.field("restitution", &RoundRegime::restitution,
          {.unit = "1",
           .meaning = "speed ratio of a bounce where the surface names none",
           .minimum = 0.0,
           .maximum = 1.0});
  v.field("friction", &RoundRegime::friction,
          {.unit = "1",
           .meaning = "coefficient of sliding friction where the surface names none",
           .minimum = 0.0,
           .maximum = 10.0});
  v.field("rolling", &RoundRegime::rolling,
          {.unit = "1",
           .meaning = "coefficient of rolling resistance where the surface names none",
           .minimum = 0.0,
           .maximum = 1.0});
}

/// One Runge–Kutta step of fourth order. Rates: FlightRate(const FlightState&, double time).
template <class Rates>
FlightState runge_kutta(const FlightState& state, double time, double step, const Rates& rates) {
  const auto moved = [&state](const FlightState& there, const FlightRate& rate, double h) {
    FlightState next = state;
    next.position += h * there.velocity;
    next.velocity += h * rate.acceleration;
    next.angle += h * there.spin;
    next.spin += h * rate.spin;
    return next;
  };
  const FlightRate k1 = rates(state, time);
  const FlightState s2 = moved(state, k1, step / 2.0);
  const FlightRate k2 = rates(s2, time + step / 2.0);
  const FlightState s3 = moved(s2, k2, step / 2.0);
  const FlightRate k3 = rates(s3, time + step / 2.0);
  const FlightState s4 = moved(s3, k3, step);
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

/// Where `gap` falls to zero between `clear` and `touching`, to about 1e-12: the Illinois variant
/// of the false position method (Dowell & Jarratt 1971). A body that still touches at `clear`,
/// where it has just bounced, and recedes, comes back after the top of its hop.
template <class Gap, class Recedes>
double find_impact(double clear, double touching, const Gap& gap, const Recedes& recedes) {
  constexpr double kExact = 1e-12;  // [m] and [s]
  double clear_gap = gap(clear);
  if (clear_gap < kExact) {
    if (!recedes(clear)) return clear;
    double falling = touching;
    for (const double enough = 1e-3 * (touching - clear); falling - clear > enough;) {
      const double middle = 0.5 * (clear + falling);
      (recedes(middle) ? clear : falling) = middle;
    }
    clear_gap = gap(clear);
  }
  double touching_gap = gap(touching);
  if (!(clear_gap > 0.0 && touching_gap < 0.0)) return touching;
  int same_side = 0;  // how often, with its sign, the same end has moved in a row
  for (int i = 0; i < 100 && touching - clear > kExact; ++i) {
    const double guess = (clear * touching_gap - touching * clear_gap) / (touching_gap - clear_gap);
    const double guess_gap = gap(guess);
    if (std::abs(guess_gap) < kExact) return guess;
    if (guess_gap > 0.0) {
      clear = guess;
      clear_gap = guess_gap;
      same_side = std::max(same_side, 0) + 1;
      if (same_side > 1) touching_gap *= 0.5;
    } else {
      touching = guess;
      touching_gap = guess_gap;
      same_side = std::min(same_side, 0) - 1;
      if (same_side < -1) clear_gap *= 0.5;
    }
  }
  return touching;
}

/// Flies, bounces and rolls over [from, to].
template <class Rates>
void fly(FlightState& state, double from, double to, const RoundBody& body,
         const std::vector<Surface>& surfaces, const Rates& rates, ImpactLog* log) {
  // After so many impacts within a step, whatever still hits something does not bounce.
  constexpr int kMostImpacts = 100;
  constexpr int kMostChanges = 100;
  state.leans = false;
  double time = from;
  int changes = 0;
  for (int impacts = 0; time < to;) {
    if (state.support >= 0) leave_supports(state, rates(state, time), body, surfaces);
    const Senses senses = senses_of(state, body, surfaces);
    const auto rates_here = [&](const FlightState& s, double t) {
      const FlightRate free = rates(s, t);
      if (s.support < 0) return free;
      return supported_rate(s, free, body, surfaces, senses);
    };
    const auto after = [&](double part) { return runge_kutta(state, time, part, rates_here); };
    double step = to - time;
    if (state.support >= 0) step = std::min(step, longest_step_on_supports(state, surfaces));
    FlightState next = after(step);
    if (state.support >= 0 && changes_on_supports(state, next, body, surfaces) &&
        ++changes < kMostChanges) {
      double same = 0.0;
      for (const double enough = 1e-9 * step; step - same > enough;) {
        const double middle = 0.5 * (same + step);
        const bool changed = changes_on_supports(state, after(middle), body, surfaces);
        (changed ? step : same) = middle;
      }
      next = after(step);
    }
    const Approach approach = first_approach(state, next, step, body, surfaces);
    if (approach.surface < 0) {
      const FlightState before = state;
      const double began = time;
      state = next;
      time = step == to - time ? to : time + step;
      if (state.support >= 0 && settle_on_supports(state, body, surfaces, senses.turning)) {
        keep_energy(before, state, rates(before, began), rates(state, time), body);
      }
      if (state.support >= 0 && is_nearly_at_rest(state)) {
        rest(state, rates(state, time), body, surfaces);
      }
      continue;
    }
    const auto index = static_cast<std::size_t>(approach.surface);
    const auto gap = [&](double part) {
      return surfaces[index].contact(after(part).position).distance - body.radius;
    };
    const auto recedes = [&](double part) {
      const FlightState there = after(part);
      return there.velocity.dot(surfaces[index].contact(there.position).normal) >= 0.0;
    };
    const double impact_time =
        find_impact(approach.clear * step, approach.touching * step, gap, recedes);
    state = after(impact_time);
    time += impact_time;
    RoundBody struck = body;
    if (++impacts > kMostImpacts) struck.restitution = 0.0;
    const Vec2 impulse = bounce(state, rates(state, time), struck, surfaces, index);
    if (log != nullptr && impulse != Vec2::Zero()) {
      log->push_back({time, approach.surface, state.position, impulse});
    }
    if (impacts <= 2 * kMostImpacts) continue;
    // Wedged: it stays where it is until the step's end.
    const Vec2 rest = stop_wedged(state, body, surfaces);
    if (log != nullptr && rest != Vec2::Zero()) {
      log->push_back({time, approach.surface, state.position, rest});
    }
    return;
  }
}

/// The same for forces that may be stiff: `stiffness(state, time)` is the rate [1/s] at which they
/// change with the motion. A step is no longer than half its inverse at the beginning, nor, by
/// trial, than its inverse at the end. As drag is quadratic the rate falls with the speed through
/// the air, so even a balloon in a hurricane needs few steps.
template <class Rates, class Stiffness>
void fly_stiffly(FlightState& state, double from, double to, const RoundBody& body,
                 const std::vector<Surface>& surfaces, const Rates& rates,
                 const Stiffness& stiffness, ImpactLog* log) {
  const double shortest = 1e-5 * (to - from);
  double now = stiffness(state, from);
  for (double time = from; time < to;) {
    double step = to - time;
    if (now * step > 0.5) step = std::max(0.5 / now, shortest);
    for (;;) {
      const double end = step >= to - time ? to : time + step;
      FlightState next = state;
      const std::size_t logged = log != nullptr ? log->size() : 0;
      fly(next, time, end, body, surfaces, rates, log);
      const double then = stiffness(next, end);
      if (then * step <= 1.0 || step <= shortest) {
        state = next;
        now = then;
        time = end;
        break;
      }
      step = std::max(0.25 * step, shortest);
      if (log != nullptr) log->resize(logged);
    }
  }
}

/// The same for a model, through wind that may jump or bend at instants: each part that is smooth
/// is flown by itself, and forces are asked for inside it only.
template <IsRoundModel Model>
void fly_in_wind(const Model& model, FlightState& state, const Environment& environment,
                 double from, double to, ImpactLog* log) {
  const RoundBody body = model.round(environment);
  environment.wind().over_smooth_parts(from, to, [&](double begin, double end) {
    const auto at = [&](double time) {
      return SmoothInstant{Wind::inside(time, begin, end), begin, end};
    };
    fly_stiffly(
        state, begin, end, body, environment.surfaces(),
        [&](const FlightState& s, double time) { return model.rate(s, environment, at(time)); },
        [&](const FlightState& s, double time) {
          return model.stiffness(s, environment, at(time));
        },
        log);
  });
}

}  // namespace ghtrack

#pragma once

#include <concepts>
#include <string_view>
#include <vector>

#include "sim/environment.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// Where an object is and how it moves, world frame.
struct PlanarMotion {
  Vec2 position = Vec2::Zero();      // [m]
  Vec2 velocity = Vec2::Zero();      // [m/s]
  Vec2 acceleration = Vec2::Zero();  // [m/s²]
};

/// One rigid part of an object at one instant.
struct RigidBody {
  Vec2 position = Vec2::Zero();  // of the centre [m]
  Vec2 velocity = Vec2::Zero();  // [m/s]
  double angle = 0.0;            // [rad]
  double spin = 0.0;             // [rad/s]
};

/// How an object's parts meet other objects.
struct ContactProperties {
  Outline outline;
  double restitution = 0.0;
  double friction = 0.0;
};

/// What struck a surface of the surroundings, or what else has happened to an object by itself.
struct Impact {
  double time = 0.0;             // [s]
  int surface = 0;               // index of the environment's surface; −1: none
  Vec2 position = Vec2::Zero();  // of the body's centre [m]
  Vec2 impulse = Vec2::Zero();   // that the body received [N s]
  EventKind kind = EventKind::kContact;
  int object = 0;  // of the target's, where it has several
  int other = -1;  // another one of the target's, if it has to do with that
};
using ImpactLog = std::vector<Impact>;

/// What a model of motion must offer. A model is immutable; its State, a value, is all that
/// changes.
///   start(environment, time)                 the state at the moment of appearance
///   advance(state, environment, from, to, log)  integrates the equations of motion over
///                                            [from, to], bounces on the surroundings included;
///                                            adds these to the log, if there is one
///   objects(), kinematics(state, …, object)  what the sensors may see: one object, or one per part
///   bodies(), body(state, environment, i)    its rigid parts
///   contact()                                how these meet other objects
/// Its parts move on regardless of what they hit, unless it is one of IsRoundModel too.
template <class M>
concept IsMotionModel = std::copyable<typename M::State> &&
    requires(const M& model, typename M::State& state, const Environment& environment, double time,
             int index, ImpactLog* log) {
  { model.start(environment, time) } -> std::same_as<typename M::State>;
  { model.advance(state, environment, time, time, log) } -> std::same_as<void>;
  { model.objects() } -> std::same_as<int>;
  { model.kinematics(state, environment, time, index) } -> std::same_as<PlanarMotion>;
  { model.bodies() } -> std::same_as<int>;
  { model.body(state, index) } -> std::same_as<RigidBody>;
  { model.contact() } -> std::same_as<ContactProperties>;
};

/// What a regime of motion must be: a described configuration with a name and a model.
///   position       where it begins [m]
///   shift(by)      moves it and all that it will do to another place
///   hasten(by)     changes the velocity with which it begins [m/s], as far as its track, route or
///                  rod lets it: by the part along it
///   unreleasable() why nothing can let go of it on the way; empty: something can
/// One whose motion is random by a known law may offer that, too: see motion_law.hpp.
template <class R>
concept IsRegime = IsMotionModel<typename R::Model> &&
    std::constructible_from<typename R::Model, const R&> && requires(R regime, const Vec2& by) {
  { R::kind } -> std::convertible_to<std::string_view>;
  { regime.position } -> std::convertible_to<Vec2>;
  regime.shift(by);
  regime.hasten(by);
  { regime.unreleasable() } -> std::convertible_to<std::string_view>;
};

}  // namespace ghtrack

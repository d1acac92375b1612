#pragma once

#include <concepts>
#include <string_view>

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
  double mass = 0.0;     // [kg]; 0: moves on regardless, as a train does when a ball hits it
  double inertia = 0.5;  // moment of inertia / (mass × radius²)
  double restitution = 0.0;
  double friction = 0.0;
};

/// What a model of motion must offer. A model is immutable; its State, a value, is all that
/// changes.
///   start(environment, time)                 the state at the moment of appearance
///   advance(state, environment, from, to)    integrates the equations of motion over [from, to],
///                                            bounces on the surroundings included
///   objects(), kinematics(state, …, object)  what the sensors may see: one object, or one per part
///   bodies(), body(state, environment, i)    its rigid parts
///   contact()                                how these meet other objects
///   adopt(state, body)                       takes over what a collision made of its only part
template <class M>
concept IsMotionModel = std::copyable<typename M::State> &&
    requires(const M& model, typename M::State& state, const Environment& environment,
             const RigidBody& body, double time, int index) {
  { model.start(environment, time) } -> std::same_as<typename M::State>;
  { model.advance(state, environment, time, time) } -> std::same_as<void>;
  { model.objects() } -> std::same_as<int>;
  { model.kinematics(state, environment, time, index) } -> std::same_as<PlanarMotion>;
  { model.bodies() } -> std::same_as<int>;
  { model.body(state, index) } -> std::same_as<RigidBody>;
  { model.contact() } -> std::same_as<ContactProperties>;
  { model.adopt(state, body) } -> std::same_as<void>;
};

/// What a regime of motion must be: a described configuration with a name and a model.
///   position       where it begins [m]
///   shift(by)      moves it and all that it will do to another place
///   hasten(by)     changes the velocity with which it begins [m/s]
template <class R>
concept IsRegime = IsMotionModel<typename R::Model> &&
    std::constructible_from<typename R::Model, const R&> && requires(R regime, const Vec2& by) {
  { R::kind } -> std::convertible_to<std::string_view>;
  { regime.position } -> std::convertible_to<Vec2>;
  regime.shift(by);
  regime.hasten(by);
};

}  // namespace ghtrack

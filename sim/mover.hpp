#pragma once

#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "sim/environment.hpp"
#include "sim/regimes/free_flight.hpp"
#include "sim/target.hpp"

namespace ghtrack {

/// The one place that folds over the list of regimes: the motion of a target of any regime.
class Mover {
  template <class Model>
  struct StateOf {  // models may share a type of state
    typename Model::State state;
  };
  template <class Variant>
  struct Fold;
  template <class... R>
  struct Fold<std::variant<R...>> {
    using Models = std::variant<typename R::Model...>;
    using States = std::variant<std::monostate, StateOf<typename R::Model>...>;
  };

 public:
  /// Empty until the target appears.
  using State = Fold<Regime>::States;

  Mover(const Target& target, const Environment& environment);

  std::uint64_t key() const { return key_; }
  const ContactProperties& contact() const { return contact_; }
  double appears() const { return appears_; }
  int objects() const;
  int bodies() const;

  /// Whether the target is there at this time.
  bool present(double time) const { return time >= appears_ && time < disappears_; }

  /// Starts the target at a time, let go by a carrier that moves like this then.
  void release(State& state, const Environment& environment, const PlanarMotion& carrier,
               double time) const;

  /// Integrates over [from, to] as far as the target is there; starts it if it appears. Impacts on
  /// the surroundings are added to the log, if there is one.
  void advance(State& state, const Environment& environment, double from, double to,
               ImpactLog* log) const;

  PlanarMotion kinematics(const State& state, const Environment& environment, double time,
                          int object) const;
  RigidBody body(const State& state, int index) const;

  /// Whether it is a round body, which gives way unless it is held.
  bool may_yield() const { return round_.mass > 0.0; }

  /// What matters of a round body when it is hit.
  /// @pre flight() is not null
  const RoundBody& round() const { return round_; }

  /// The state of a round body that gives way; null: it moves on regardless, or is not there.
  FlightState* flight(State& state) const;
  const FlightState* flight(const State& state) const { return flight(const_cast<State&>(state)); }

  /// Its model and its state if it is a train; null otherwise, and where it is not there.
  const TrainModel* train() const { return std::get_if<TrainModel>(&model_); }
  TrainModel::State* train(State& state) const;
  const TrainModel::State* train(const State& state) const {
    return train(const_cast<State&>(state));
  }

  /// What forces but those of contact do to it, and how fast they change.
  /// @pre flight() is not null
  FlightRate rate(const FlightState& state, const Environment& environment,
                  const SmoothInstant& now) const;
  double stiffness(const FlightState& state, const Environment& environment,
                   const SmoothInstant& now) const;

 private:
  Fold<Regime>::Models model_;
  std::uint64_t key_;
  double appears_;
  double disappears_;
  ContactProperties contact_;
  RoundBody round_{};
};

}  // namespace ghtrack

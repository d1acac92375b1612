#include "sim/mover.hpp"

#include <algorithm>
#include <concepts>
#include <utility>

#include "sim/random.hpp"

namespace ghtrack {
namespace {

/// Random motion is told where its numbers come from, and what goes up and down along a track how
/// heavy it is.
template <class Models>
Models make_model(const Regime& regime, const RandomSource& source, const Vec2& gravity) {
  return std::visit(
      [&]<class R>(const R& r) {
        using Model = typename R::Model;
        if constexpr (std::constructible_from<Model, const R&, const RandomSource&>) {
          return Models(Model(r, source));
        } else if constexpr (std::constructible_from<Model, const R&, const Vec2&>) {
          return Models(Model(r, gravity));
        } else {
          return Models(Model(r));
        }
      },
      regime);
}

}  // namespace

Mover::Mover(const Target& target, const Environment& environment)
    : model_(make_model<Fold<Regime>::Models>(
          target.motion, {environment.seed(), key_of(target.name)}, environment.gravity())),
      key_(key_of(target.name)),
      appears_(target.appears),
      disappears_(target.disappears.value_or(std::numeric_limits<double>::infinity())),
      contact_(std::visit([](const auto& model) { return model.contact(); }, model_)) {
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (IsRoundModel<Model>) round_ = model.round(environment);
      },
      model_);
}

int Mover::objects() const {
  return std::visit([](const auto& model) { return model.objects(); }, model_);
}

int Mover::bodies() const {
  return std::visit([](const auto& model) { return model.bodies(); }, model_);
}

void Mover::advance(State& state, const Environment& environment, double from, double to,
                    ImpactLog* log) const {
  if (to < appears_ || from >= disappears_) return;
  std::visit(
      [&]<class Model>(const Model& model) {
        double begin = from;
        if (std::holds_alternative<std::monostate>(state)) {
          begin = std::max(from, appears_);
          state = StateOf<Model>{model.start(environment, begin)};
        }
        model.advance(std::get<StateOf<Model>>(state).state, environment, begin, to, log);
      },
      model_);
}

void Mover::release(State& state, const Environment& environment, const PlanarMotion& carrier,
                    double time) const {
  std::visit(
      [&]<class Model>(const Model& model) {
        state = StateOf<Model>{model.start(environment, time)};
        if constexpr (IsRoundModel<Model>) {
          FlightState* const flight = model.flight(std::get<StateOf<Model>>(state).state);
          flight->position += carrier.position;
          flight->velocity += carrier.velocity;
        }
      },
      model_);
}

PlanarMotion Mover::kinematics(const State& state, const Environment& environment, double time,
                               int object) const {
  return std::visit(
      [&]<class Model>(const Model& model) {
        return model.kinematics(std::get<StateOf<Model>>(state).state, environment, time, object);
      },
      model_);
}

RigidBody Mover::body(const State& state, int index) const {
  return std::visit(
      [&]<class Model>(const Model& model) {
        return model.body(std::get<StateOf<Model>>(state).state, index);
      },
      model_);
}

FlightState* Mover::flight(State& state) const {
  return std::visit(
      [&]<class Model>(const Model& model) -> FlightState* {
        if constexpr (IsRoundModel<Model>) {
          auto* const there = std::get_if<StateOf<Model>>(&state);
          return there != nullptr ? model.flight(there->state) : nullptr;
        } else {
          return nullptr;
        }
      },
      model_);
}

TrainModel::State* Mover::train(State& state) const {
  auto* const there = std::get_if<StateOf<TrainModel>>(&state);
  return there != nullptr ? &there->state : nullptr;
}

FlightRate Mover::rate(const FlightState& state, const Environment& environment,
                       const SmoothInstant& now) const {
  return std::visit(
      [&]<class Model>(const Model& model) -> FlightRate {
        if constexpr (IsRoundModel<Model>) return model.rate(state, environment, now);
        return {};
      },
      model_);
}

double Mover::stiffness(const FlightState& state, const Environment& environment,
                        const SmoothInstant& now) const {
  return std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (IsRoundModel<Model>) return model.stiffness(state, environment, now);
        return 0.0;
      },
      model_);
}

}  // namespace ghtrack

#include "sim/mover.hpp"

#include <algorithm>
#include <utility>

#include "sim/random.hpp"

namespace ghtrack {
namespace {

template <class Models>
Models make_model(const Regime& regime) {
  return std::visit(
      [](const auto& r) { return Models(typename std::decay_t<decltype(r)>::Model(r)); }, regime);
}

}  // namespace

Mover::Mover(const Target& target)
    : model_(make_model<Fold<Regime>::Models>(target.motion)),
      key_(key_of(target.name)),
      appears_(target.appears),
      disappears_(target.disappears.value_or(std::numeric_limits<double>::infinity())),
      contact_(std::visit([](const auto& model) { return model.contact(); }, model_)) {}

int Mover::objects() const {
  return std::visit([](const auto& model) { return model.objects(); }, model_);
}

int Mover::bodies() const {
  return std::visit([](const auto& model) { return model.bodies(); }, model_);
}

void Mover::advance(State& state, const Environment& environment, double from, double to) const {
  if (to < appears_ || from >= disappears_) return;
  std::visit(
      [&]<class Model>(const Model& model) {
        double begin = from;
        if (std::holds_alternative<std::monostate>(state)) {
          begin = std::max(from, appears_);
          state = StateOf<Model>{model.start(environment, begin)};
        }
        model.advance(std::get<StateOf<Model>>(state).state, environment, begin, to);
      },
      model_);
}

void Mover::release(State& state, const Environment& environment, const PlanarMotion& carrier,
                    double time) const {
  std::visit(
      [&]<class Model>(const Model& model) {
        typename Model::State started = model.start(environment, time);
        RigidBody body = model.body(started, 0);
        body.position += carrier.position;
        body.velocity += carrier.velocity;
        model.adopt(started, body);
        state = StateOf<Model>{std::move(started)};
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

void Mover::adopt(State& state, const RigidBody& body) const {
  std::visit([&]<class Model>(
                 const Model& model) { model.adopt(std::get<StateOf<Model>>(state).state, body); },
             model_);
}

}  // namespace ghtrack

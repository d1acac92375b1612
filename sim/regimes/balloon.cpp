#include "sim/regimes/balloon.hpp"

#include <cmath>
#include <vector>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

Balloon make_preset(std::string_view type, double radius, double envelope_mass) {
  Balloon balloon;
  balloon.type = type;
  balloon.radius = radius;
  balloon.envelope_mass = envelope_mass;
  return balloon;
}

/// What the forces of flight depend on beside the motion.
struct Coefficients {
  double drag_per_speed;  // acceleration by drag / squared speed through the air [1/m]
  double sinking;         // part of gravity that is left
  double carried;         // part of the air's own acceleration that the balloon takes part in
};

Coefficients coefficients_of(const auto& form, const Balloon& balloon, double mass) {
  const double carried =
      balloon.fluid_acceleration ? (1.0 + balloon.added_mass) * form.displaced / form.inertia : 0.0;
  return {form.drag_per_speed, (mass - form.displaced) / form.inertia, carried};
}

FlightRate rate_with(const Coefficients& balloon, const FlightState& state,
                     const Environment& environment, const SmoothInstant& now) {
  const Wind& wind = environment.wind();
  const Vec2 air = wind.at(state.position, now.time) - state.velocity;
  FlightRate rate;
  rate.acceleration =
      balloon.drag_per_speed * air.norm() * air + balloon.sinking * environment.gravity();
  if (balloon.carried != 0.0) {
    rate.acceleration += balloon.carried * wind.material_derivative(state.position, now.time,
                                                                    now.earliest, now.latest);
  }
  return rate;
}

double stiffness_with(double drag_per_speed, const FlightState& state,
                      const Environment& environment, const SmoothInstant& now) {
  const Vec2 air = state.velocity - environment.wind().at(state.position, now.time);
  return 2.0 * drag_per_speed * air.norm();
}

}  // namespace

std::span<const Balloon> Balloon::presets() {
  // Spheres of the volumes that balloon makers print: 0.25, 0.5, 1.5 and 16 cubic feet for latex of
  // 9, 11, 16 and 36 inches; a pilot balloon (30 g) as meteorologists release it.
  static const std::vector<Balloon> rows{
      make_preset("latex-11-inch", 0.14, 0.0032), make_preset("latex-9-inch", 0.114, 0.0022),
      make_preset("latex-16-inch", 0.2, 0.0064),  make_preset("latex-36-inch", 0.457, 0.060),
      make_preset("pilot-30-g", 0.35, 0.030),
  };
  return rows;
}

BalloonModel::BalloonModel(const Balloon& balloon)
    : balloon_(balloon),
      volume_(4.0 / 3.0 * portable::kPi * balloon.radius * balloon.radius * balloon.radius),
      mass_(balloon.envelope_mass + balloon.gas_density * volume_) {}

BalloonModel::State BalloonModel::start(const Environment&, double) const {
  State state;
  state.position = balloon_.position;
  state.velocity = balloon_.velocity;
  return state;
}

void BalloonModel::advance(State& state, const Environment& environment, double from, double to,
                           ImpactLog* log) const {
  const bool is_steady = !balloon_.expands && environment.air().atmosphere == Atmosphere::kUniform;
  if (!is_steady) {
    fly_in_wind(*this, state, environment, from, to, log);
  } else {
    // Nothing but the motion changes on the way: divisions are for once.
    struct Steady {
      using State = FlightState;
      const BalloonModel& model;
      Coefficients coefficients;

      RoundBody round(const Environment& there) const { return model.round(there); }
      FlightState* flight(State& flying) const { return &flying; }
      FlightRate rate(const FlightState& flying, const Environment& there,
                      const SmoothInstant& now) const {
        return rate_with(coefficients, flying, there, now);
      }
      double stiffness(const FlightState& flying, const Environment& there,
                       const SmoothInstant& now) const {
        return stiffness_with(coefficients.drag_per_speed, flying, there, now);
      }
    };
    const Steady steady{*this, coefficients_of(form(state, environment), balloon_,
                                               state.is_burst ? balloon_.envelope_mass : mass_)};
    fly_in_wind(steady, state, environment, from, to, log);
  }
  if (!balloon_.burst_radius || state.is_burst) return;
  const double ratio = *balloon_.burst_radius / balloon_.radius;
  if (growth(state, environment) < ratio * ratio * ratio) return;
  state.is_burst = true;
  if (log != nullptr) log->push_back({to, -1, state.position, Vec2::Zero(), EventKind::kBurst});
}

/// Volume / volume at the start.
double BalloonModel::growth(const FlightState& state, const Environment& environment) const {
  if (!balloon_.expands) return 1.0;
  return environment.air_density(balloon_.position.y()) /
         environment.air_density(state.position.y());
}

BalloonModel::Form BalloonModel::form(const FlightState& state,
                                      const Environment& environment) const {
  const double density = environment.air_density(state.position.y());
  if (state.is_burst) {
    const double mass = balloon_.envelope_mass;
    return {0.0, mass, 0.5 * density * balloon_.fall_drag_area / mass};
  }
  double volume = volume_;
  double area = portable::kPi * balloon_.radius * balloon_.radius;
  if (balloon_.expands) {
    const double grown = growth(state, environment);
    volume *= grown;
    area *= portable::pow(grown, 2.0 / 3.0);
  }
  const double displaced = density * volume;
  const double inertia = mass_ + balloon_.added_mass * displaced;
  return {displaced, inertia,
          0.5 * density * balloon_.drag * area / (mass_ + balloon_.added_mass * density * volume)};
}

FlightRate BalloonModel::rate(const FlightState& state, const Environment& environment,
                              const SmoothInstant& now) const {
  const Form form = this->form(state, environment);
  const double mass = state.is_burst ? balloon_.envelope_mass : mass_;
  return rate_with(coefficients_of(form, balloon_, mass), state, environment, now);
}

double BalloonModel::stiffness(const FlightState& state, const Environment& environment,
                               const SmoothInstant& now) const {
  return stiffness_with(form(state, environment).drag_per_speed, state, environment, now);
}

PlanarMotion BalloonModel::kinematics(const State& state, const Environment& environment,
                                      double time, int) const {
  return flight_kinematics(state, rate(state, environment, {.time = time}), round(environment),
                           environment.surfaces());
}

RigidBody BalloonModel::body(const State& state, int) const { return body_in_flight(state); }

ContactProperties BalloonModel::contact() const {
  return {{Outline::Shape::kBalloon, 2.0 * balloon_.radius, 2.0 * balloon_.radius},
          balloon_.restitution,
          balloon_.friction};
}

RoundBody BalloonModel::round(const Environment& environment) const {
  // A push moves the air around the balloon too; a thin shell turns without it.
  constexpr double kThinShell = 0.667;
  const double moved = mass_ + balloon_.added_mass * environment.air().density * volume_;
  return {balloon_.radius,   kThinShell * mass_ / moved, balloon_.restitution,
          balloon_.friction, balloon_.rolling,           moved};
}

}  // namespace ghtrack

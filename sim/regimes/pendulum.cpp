#include "sim/regimes/pendulum.hpp"

#include <cmath>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

// The method takes (ω h)⁶/144 of an amplitude in a step: with ω h at most this, energy stays the
// same to 1e-9 for hours.
constexpr double kMostPhase = 0.006;

Vec2 from_pivot(double angle) { return -left_of(direction(angle)); }

}  // namespace

void Pendulum::hasten(const Vec2& by) {
  rate_deg += by.dot(direction(angle_deg * portable::kDegree)) / length / portable::kDegree;
}

PendulumModel::State PendulumModel::start(const Environment&, double) const {
  return {pendulum_.angle_deg * portable::kDegree, pendulum_.rate_deg * portable::kDegree};
}

double PendulumModel::angular_acceleration(const State& state,
                                           const Environment& environment) const {
  return environment.gravity().dot(direction(state.angle)) / pendulum_.length -
         pendulum_.damping * state.rate;
}

void PendulumModel::advance(State& state, const Environment& environment, double from, double to,
                            ImpactLog*) const {
  const double frequency = std::sqrt(environment.gravity().norm() / pendulum_.length) +
                           pendulum_.damping + std::abs(state.rate);
  const int steps = 1 + static_cast<int>((to - from) * frequency / kMostPhase);
  const double h = (to - from) / steps;
  const auto moved = [&state](double rate, double acceleration, double by) {
    return State{state.angle + by * rate, state.rate + by * acceleration};
  };
  for (int i = 0; i < steps; ++i) {
    const double k1 = angular_acceleration(state, environment);
    const State s2 = moved(state.rate, k1, 0.5 * h);
    const double k2 = angular_acceleration(s2, environment);
    const State s3 = moved(s2.rate, k2, 0.5 * h);
    const double k3 = angular_acceleration(s3, environment);
    const State s4 = moved(s3.rate, k3, h);
    const double k4 = angular_acceleration(s4, environment);
    state = {state.angle + h / 6.0 * (state.rate + 2.0 * s2.rate + 2.0 * s3.rate + s4.rate),
             state.rate + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)};
  }
}

PlanarMotion PendulumModel::kinematics(const State& state, const Environment& environment, double,
                                       int) const {
  const double length = pendulum_.length;
  const Vec2 outwards = from_pivot(state.angle);
  const Vec2 along = direction(state.angle);
  return {pendulum_.position + length * outwards, length * state.rate * along,
          length * (angular_acceleration(state, environment) * along -
                    state.rate * state.rate * outwards)};
}

RigidBody PendulumModel::body(const State& state, int) const {
  return {pendulum_.position + pendulum_.length * from_pivot(state.angle),
          pendulum_.length * state.rate * direction(state.angle), state.angle, state.rate};
}

ContactProperties PendulumModel::contact() const {
  return {{Outline::Shape::kDisc, 2.0 * pendulum_.radius, 2.0 * pendulum_.radius}, 0.5, 0.3};
}

}  // namespace ghtrack

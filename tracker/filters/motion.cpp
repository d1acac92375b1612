#include "tracker/filters/motion.hpp"

#include <algorithm>
#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kStraight = 1e-9;  // [rad]; a turn of less is none

/// Writes the covariance of one axis onto all.
MotionCovariance on_axes(int axes, const AxisCovariance<double>& q, int order, int states) {
  MotionCovariance all = MotionCovariance::Zero(states, states);
  const auto set = [&](int i, int j, double value) {
    for (int axis = 0; axis < axes; ++axis) {
      all(axes * i + axis, axes * j + axis) = value;
      all(axes * j + axis, axes * i + axis) = value;
    }
  };
  set(0, 0, q.xx);
  if (order >= 1) {
    set(0, 1, q.xv);
    set(1, 1, q.vv);
  }
  if (order >= 2) {
    set(0, 2, q.xa);
    set(1, 2, q.va);
    set(2, 2, q.aa);
  }
  return all;
}

/// White noise in the acceleration, and in one component more.
MotionCovariance with_one_more(double acceleration_density, double density, double dt) {
  MotionCovariance q =
      on_axes(2, process_noise(ProcessModel::kWhiteNoise, 1, acceleration_density, dt), 1, 5);
  q(4, 4) = density * dt;
  return q;
}

}  // namespace

MotionState PolynomialMotion::moved(const MotionState& x, double dt) const {
  const Eigen::Index axes = x.size() / (order + 1);
  MotionState next = x;
  if (order >= 1) next.head(axes) += dt * x.segment(axes, axes);
  if (order >= 2) {
    next.head(axes) += 0.5 * dt * dt * x.tail(axes);
    next.segment(axes, axes) += dt * x.tail(axes);
  }
  return next;
}

MotionCovariance PolynomialMotion::noise(const MotionState& x, double dt) const {
  AxisCovariance<double> q = implied.over(dt);
  if (process_intensity > 0.0) {
    q += process_noise(process_model, order, process_intensity, dt, renewal);
  }
  const auto states = static_cast<int>(x.size());
  return on_axes(states / (order + 1), q, order, states);
}

MotionState CoordinatedTurn::moved(const MotionState& x, double dt) const {
  const double angle = x[4] * dt;
  const auto [s, c] = portable::sin_cos(angle);
  const bool is_straight = std::abs(angle) < kStraight;
  const double along = is_straight ? dt : s / x[4];
  const double across = is_straight ? 0.5 * angle * dt : (1.0 - c) / x[4];
  MotionState next = x;
  next[0] += along * x[2] - across * x[3];
  next[1] += across * x[2] + along * x[3];
  next[2] = c * x[2] - s * x[3];
  next[3] = s * x[2] + c * x[3];
  return next;
}

MotionCovariance CoordinatedTurn::noise(const MotionState&, double dt) const {
  return with_one_more(spectral_density, turn_density, dt);
}

/// By Runge and Kutta's fourth order, in steps in which the drag changes little.
MotionState Ballistic::moved(const MotionState& x, double dt) const {
  constexpr double kLongestStep = 0.05;  // [s]
  constexpr double kMostSteps = 1000.0;
  const double c = std::max(x[4], 0.0);
  const auto rate = [&](const Eigen::Vector4d& s) {
    const double speed = s.tail<2>().norm();
    return Eigen::Vector4d(s[2], s[3], -c * speed * s[2], -c * speed * s[3] - gravity);
  };
  const double steps = std::min(std::ceil(dt / kLongestStep), kMostSteps);
  const double h = dt / steps;
  Eigen::Vector4d s = x.head<4>();
  for (int i = 0; i < static_cast<int>(steps); ++i) {
    const Eigen::Vector4d k1 = rate(s);
    const Eigen::Vector4d k2 = rate(s + 0.5 * h * k1);
    const Eigen::Vector4d k3 = rate(s + 0.5 * h * k2);
    const Eigen::Vector4d k4 = rate(s + h * k3);
    s += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  MotionState next = x;
  next.head<4>() = s;
  return next;
}

MotionCovariance Ballistic::noise(const MotionState&, double dt) const {
  return with_one_more(spectral_density, drag_density, dt);
}

bool needs_plane(const TargetMotion& motion) {
  return !std::holds_alternative<PolynomialMotion>(motion);
}

int states_of(const TargetMotion& motion, int axes) {
  const auto* polynomial = std::get_if<PolynomialMotion>(&motion);
  return polynomial != nullptr ? axes * (polynomial->order + 1) : 5;
}

StateComponent component_of(const TargetMotion& motion, int i, int axes) {
  if (axes == 1) return static_cast<StateComponent>(2 * i);
  if (i < 4 || !needs_plane(motion)) return static_cast<StateComponent>(i);
  return std::holds_alternative<CoordinatedTurn>(motion) ? StateComponent::kTurnRate
                                                         : StateComponent::kDrag;
}

FirstGuess first_guess_of(const TargetMotion& motion, int) {
  struct Guess {
    FirstGuess operator()(const PolynomialMotion& m) const { return {0.0, m.initial_acceleration}; }
    FirstGuess operator()(const CoordinatedTurn& m) const { return {0.0, m.initial_turn_rate}; }
    FirstGuess operator()(const Ballistic& m) const { return {m.drag, m.drag_sigma}; }
  };
  return std::visit(Guess{}, motion);
}

MotionState moved(const TargetMotion& motion, const MotionState& x, double dt) {
  return std::visit([&](const auto& m) { return m.moved(x, dt); }, motion);
}

MotionCovariance noise(const TargetMotion& motion, const MotionState& x, double dt) {
  return std::visit([&](const auto& m) { return m.noise(x, dt); }, motion);
}

}  // namespace ghtrack

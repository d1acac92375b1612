#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "tracker/filters/gains/gains.hpp"

namespace ghtrack {

/// Position and its derivatives on D axes, SI units.
template <int D>
struct Kinematics {
  using Vector = Eigen::Matrix<double, D, 1>;
  Vector position = Vector::Zero();
  Vector velocity = Vector::Zero();
  Vector acceleration = Vector::Zero();

  bool is_finite() const {
    return position.allFinite() && velocity.allFinite() && acceleration.allFinite();
  }
};

/// Motion under constant acceleration: x + v T + a T² / 2, v + a T.
template <int D>
Kinematics<D> extrapolated(const Kinematics<D>& from, double dt) {
  return {from.position + dt * from.velocity + (0.5 * dt * dt) * from.acceleration,
          from.velocity + dt * from.acceleration, from.acceleration};
}

/// x + g r, v + (h / T) r, a + (2k / T²) r.
template <int D>
Kinematics<D> corrected(const Kinematics<D>& prior, const typename Kinematics<D>::Vector& residual,
                        const Gains& gains, double dt) {
  return {prior.position + gains.g * residual, prior.velocity + (gains.h / dt) * residual,
          prior.acceleration + (2.0 * gains.k / (dt * dt)) * residual};
}

/// Inputs that a filter did not use.
struct Refusals {
  std::int64_t times = 0;         // steps that are not positive, not finite, or overflow the state
  std::int64_t measurements = 0;  // measurements that are not finite, or overflow the state
};

}  // namespace ghtrack

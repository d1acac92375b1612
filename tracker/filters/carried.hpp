#pragma once

#include "tracker/filters/motion_filter.hpp"

namespace ghtrack {

/// A state and its covariance some time later, and the covariance of the state then with that now.
struct Carried {
  MotionState x;
  MotionCovariance p;
  MotionCovariance cross;  // E[(x_now − x̂_now)(x_then − x̂_then)ᵀ]
};

/// What a filter of this motion predicts for dt seconds later, process noise included.
Carried carried(const TargetMotion& motion, Propagation propagation, const MotionState& x,
                const MotionCovariance& p, double dt);

}  // namespace ghtrack

#pragma once

#include <span>

#include "tracker/filters/gains/gains.hpp"
#include "tracker/filters/kinematics.hpp"

// Many filters with the same gains and the same step, stored as one array per quantity: what a
// replay over thousands of objects needs. One lane is one axis of one object. Same bits as
// GainFilter, at the speed of the memory; the widest vectors of the machine are chosen when the
// program starts.

namespace ghtrack {

/// Constant gains divided by the powers of the step.
template <class Real>
struct BatchGains {
  Real dt, half_dt2;
  Real g, h_per_dt, k2_per_dt2;

  /// @param step  time between updates [s], > 0
  BatchGains(const Gains& gains, double step)
      : dt(static_cast<Real>(step)),
        half_dt2(static_cast<Real>(0.5 * step * step)),
        g(static_cast<Real>(gains.g)),
        h_per_dt(static_cast<Real>(gains.h / step)),
        k2_per_dt2(static_cast<Real>(2.0 * gains.k / (step * step))) {}
};

/// Predicts each lane by one step and corrects it with its measurement, in place.
/// All spans have one element per lane. A measurement is finite; one that is missing may be any
/// finite number.
/// @param used  1 where there is a measurement, 0 where there is none; empty: everywhere
void step_batch(const BatchGains<double>& gains, std::span<double> position,
                std::span<double> velocity, std::span<const double> z,
                std::span<const double> used = {});
void step_batch(const BatchGains<float>& gains, std::span<float> position,
                std::span<float> velocity, std::span<const float> z,
                std::span<const float> used = {});

/// The same with an acceleration that is estimated, too.
void step_batch(const BatchGains<double>& gains, std::span<double> position,
                std::span<double> velocity, std::span<double> acceleration,
                std::span<const double> z, std::span<const double> used);
void step_batch(const BatchGains<float>& gains, std::span<float> position,
                std::span<float> velocity, std::span<float> acceleration, std::span<const float> z,
                std::span<const float> used);

/// One g-h or g-h-k filter over one series: the state after each measurement, as GainFilter has it.
///
/// Each step waits for the one before it. So the series is cut into pieces that are filtered side
/// by side, each from a guess: the filter as it would be, had it begun some way before the piece. A
/// stable filter forgets how it began to the last bit; where it has not when a piece ends, the next
/// one is done again until it has. The result does not depend on the cuts.
/// @param z          measurements, one step apart; NaN is a missed one
/// @param estimates  position, velocity and, of a g-h-k filter, acceleration in turn, for each
///                   measurement
void filter_series(const Gains& gains, double dt, const Kinematics<1>& start,
                   std::span<const double> z, std::span<double> estimates);

/// Sums of squared errors of many g-h filters over one series, all started from the same guess one
/// step before its first measurement: the inner loop of a gain search.
/// @param gains   up to any number of g-h pairs
/// @param z       measurements, one step apart
/// @param truth   as many true positions
/// @param errors  one per pair; receives Σ (estimate − truth)²
void sweep_gains(std::span<const Gains> gains, double dt, double position, double velocity,
                 std::span<const double> z, std::span<const double> truth,
                 std::span<double> errors);

}  // namespace ghtrack

#pragma once

#include "tracker/filters/filter_config.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/gain_schedule.hpp"
#include "tracker/filters/imm_filter.hpp"
#include "tracker/filters/kalman_filter.hpp"
#include "tracker/filters/motion_filter.hpp"
#include "tracker/filters/multiple_model.hpp"

// From what a scene says of a filter to the numbers that it works with, for a measurement error σ
// [m] and a nominal time dt [s] between updates. The same on any number of axes.

namespace ghtrack {

/// @throws std::invalid_argument unless σ and dt are positive and finite
void require_measurable(double sigma, double dt);

/// What a GainFilter is made of.
struct GainDesign {
  GainSchedule schedule;
  ErrorModel errors;
};

/// @throws std::invalid_argument if the gains are unstable and must not be
template <int Order, gain_design::Stability S>
GainDesign designed(const GainFilterConfig<Order, S>& config, double sigma, double dt);

template <int Order>
KalmanModel designed(const KalmanConfig<Order>& config, double sigma, double dt);

/// The motion and process noise that a configuration stands for: of designed gains those that they
/// imply. A filter of it is what interacting models mix, and what a smoother carries back.
/// @throws std::invalid_argument if the gains are unstable
MotionModel equivalent_motion(const SingleFilterConfig& config, double sigma, double dt);

/// A filter on D axes that waits for its first measurement.
/// @throws std::invalid_argument if the gains are unstable, or the motion needs more dimensions
template <int D>
SingleFilter<D> make_single_filter(const SingleFilterConfig& config, double sigma, double dt);
/// Several of them, side by side and mixed.
template <int D>
MultipleModelFilter<D> make_bank(const MultipleModelConfig& config, double sigma, double dt);
template <int D>
ImmFilter<D> make_bank(const ImmConfig& config, double sigma, double dt);

}  // namespace ghtrack

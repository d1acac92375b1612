#pragma once

#include <span>
#include <string>
#include <vector>

#include "tracker/filters/filter.hpp"
#include "tracker/learning/motion_fit.hpp"
#include "tracker/learning/path.hpp"

namespace ghtrack {

/// A filter for a class of targets.
struct FilterChoice {
  FilterConfig filter;
  double gain = 0.0;  // in ln p, over a Kalman filter of constant velocity
};

/// ln p of what tracks were given, as a tracker with this filter computes it.
/// @param variance  of each sensor's error on each axis [m²], where the data don't say
/// @param interval  typical time between two detections of a target [s]
double log_likelihood(const FilterConfig& filter, std::span<const Path* const> paths,
                      std::span<const Eigen::Vector2d> variance, double interval);

/// Interacting filters that span the tracking indices that there may be: from one steadier than the
/// usual process noise to one whose velocity may turn round in an interval. Nothing that they track
/// can leave them soon, whatever it does.
ImmConfig bank(double process_density, double initial_speed, double interval);

/// The filter that makes what the tracks were given likeliest: a Kalman filter of nearly constant
/// velocity or acceleration, or interacting ones from steady to nimble, which cost more and have to
/// be clearly better.
FilterChoice choose_filter(std::span<const Path* const> paths,
                           std::span<const Eigen::Vector2d> variance, double process_density,
                           double initial_speed, double interval);

}  // namespace ghtrack

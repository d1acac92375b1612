#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/experiment/comparison.hpp"
#include "tools/experiment/trial.hpp"

namespace ghtrack {

/// What theory says of one subject of a cell, from its truth alone.
struct SubjectTheory {
  double square_acceleration = 0.0;      // mean |a|² [m²/s⁴]
  double square_jerk = 0.0;              // mean |da/dt|² [m²/s⁶]
  std::optional<double> bound_position;  // least expected RMSE [m]
  std::optional<double> bound_velocity;  // [m/s]
};

/// Theory for all subjects of a cell, averaged over its first runs.
///
/// The bound is the least expected error of 38 Kalman filters that are told which detection is
/// whose: of constant velocity and of constant acceleration, with three tracking indices per
/// decade, the best one chosen afterwards. For motion that is linear and Gaussian none can do
/// better. Of the error ellipses of detections only the axes x and y count, so behind a radar,
/// which has long and slanting ones, a filter may do better than this bound.
/// @param truths  of the first runs
/// @param jobs    threads; the outcome does not depend on them
std::vector<SubjectTheory> theory_of(const Trial& trial, std::span<const RunTruth> truths,
                                     int jobs);

/// Over how many of a cell's first runs theory averages what differs between runs.
int theory_runs(const WorldScene& scene);

/// The expected RMSE of position over a grid of g and h, for each regime, on run 0.
/// @param jobs  threads; the outcome does not depend on them
std::vector<GainSurface> gain_surfaces(const Trial& trial, const RunTruth& truth, int jobs);

/// Run 0 of a cell, thinned out for a picture.
ExampleRun example_of(const Trial& trial, const RunTruth& truth);

}  // namespace ghtrack

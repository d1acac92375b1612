#pragma once

#include <vector>

#include "tools/experiment/comparison.hpp"
#include "tools/experiment/hindsight.hpp"
#include "tools/experiment/trial.hpp"

namespace ghtrack {

/// What the truth of a subject and its detections say, whatever filters make of them.
struct SubjectTheory {
  double square_acceleration = 0.0;     // mean |a|² [m²/s⁴]
  double square_jerk = 0.0;             // mean |da/dt|² [m²/s⁶]
  double square_autocorrelation = 0.0;  // mean a · a one scan earlier [m²/s⁴]
  Hindsight hindsight;
};

/// Theory for all subjects of a cell, over runs of it. Of swarms only some objects are looked at.
/// @param jobs  threads; the outcome does not depend on them
std::vector<SubjectTheory> theory_of(const Trial& trial, const SharedTruth& truth, int first_run,
                                     int runs, int jobs);

/// Over how many of so many runs theory goes: all of them, or where they have one truth a few,
/// which differ in missed detections alone.
int theory_runs(const WorldScene& scene, int runs);

/// The expected RMSE of position over a grid of g and h, for each regime, on run 0.
/// @param jobs  threads; the outcome does not depend on them
std::vector<GainSurface> gain_surfaces(const Trial& trial, const RunTruth& truth, int jobs);

/// Run 0 of a cell, thinned out for a picture.
ExampleRun example_of(const Trial& trial, const RunTruth& truth);

}  // namespace ghtrack

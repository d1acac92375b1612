#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/motion_law.hpp"
#include "tools/experiment/labelled_objects.hpp"

namespace ghtrack {

/// How an object moves, as far as it is random: from run to run, or within one.
struct RandomMotion {
  MotionLaw law;
  double appears = 0.0;  // [s]
};

enum class Runs { kOne, kMany };

/// Which objects of a scene move at random by a law that is known exactly, by id. In many runs a
/// motion counts as random only if each run draws it anew (`compare.fresh_wind` for what has noise
/// of its own, `compare.launch` for starts); else all of them are judged on one and the same draw,
/// of which no expectation says anything.
std::vector<std::optional<RandomMotion>> random_motions(const WorldScene& scene, Runs runs);

/// The posterior Cramér–Rao bound (Tichavský, Muravchik & Nehorai 1998, "Posterior Cramér–Rao
/// bounds for discrete-time nonlinear filtering"): no filter has a smaller root mean square error
/// of the position [m] over all motions and all noise, whatever it knows of law, start and sensors
/// and of which detection is whose. Over the scans from the third detection on, given in which
/// scans there was one. For a law F, Q their recursion of the information J is that of its inverse
/// P,
///   P ← F P Fᵀ + Q,   P ← (P⁻¹ + E[Hᵀ R⁻¹ H])⁻¹,
/// with H the derivative of what is measured at the truth, averaged over the runs. An outlier
/// counts as if it said so: that is more than any filter is told, so the bound remains one, if not
/// the highest.
/// @param sensors  by ObjectScan::sensor
/// @param motions  by object
/// @return nothing if the motion of one of the objects is not known to be random, or there is none
std::optional<double> posterior_bound(const std::vector<const LabelledObject*>& objects,
                                      std::span<const SensorConfig> sensors,
                                      std::span<const std::optional<RandomMotion>> motions);

}  // namespace ghtrack

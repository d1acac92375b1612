#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace ghtrack {

/// Where something was seen, and when.
struct Glimpse {
  double time = 0.0;                                   // [s]
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
};

/// What a sensor saw in one look, each target at most once.
using SensorLook = std::vector<Glimpse>;

/// The scales of an unknown scene.
struct Scales {
  double noise = 1.0;     // 1-sigma error of a detection per axis, with what targets manoeuvre [m]
  double speed = 1.0;     // of the fastest [m/s]
  double share = 1.0;     // of the detections that are of targets which were seen before and after
  double evidence = 0.0;  // ln of how much likelier this is than that nothing moves on
};

/// The step that places are rounded to on each axis [m], such as whole pixels; 0 if there is none.
/// No noise smaller than a part of it can be told: a rounded place has an error of step / √12.
Eigen::Vector2d rounding(std::span<const std::vector<SensorLook>> sensors);

/// Finds the scales of noise and speed without a tracker and without units, from three looks in
/// turn: a detection b, one before it, a, and the nearest to where the line from a to b leads, c.
/// Of a target the residual, divided by its factor f = √(1 + (1 + α)² + α²), α the ratio of the
/// times, is normal with the noise; of chance it is spread as the detections are. Of the detections
/// b a share p goes on, each after one of the a from which it would be no faster than some speed.
/// The evidence is
///   Σ_b ln(1 − p + p mean_a N(c; a, b, σ² f²) / density);
/// the noise, share and speed for which it is greatest are returned.
/// @param sensors  of each sensor its looks, in the order of time
/// @return nothing where nothing seems to go on
std::optional<Scales> first_guess(std::span<const std::vector<SensorLook>> sensors);

}  // namespace ghtrack

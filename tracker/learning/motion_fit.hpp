#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracker/learning/path.hpp"

namespace ghtrack {

/// A number that was learned, and the interval that it lies in with a probability of 95 %.
struct Learned {
  double value = 0.0;
  double low = 0.0, high = 0.0;
  bool is_given = false;  // it was not learned, but said

  static Learned given(double value) { return {value, value, value, true}; }
};

/// How well sensors see, and how targets move: at a nearly constant velocity.
struct LearnedMotion {
  struct Noise {
    Learned x, y;  // 1-sigma error of a detection [m]
  };
  std::vector<Noise> noise;  // of each sensor
  /// Of white noise in the acceleration, by class; "default" for those without their own [m²/s³].
  std::map<std::string, Learned> process_density;
  double initial_speed = 1.0;  // 1 sigma per axis at first sight [m/s]
};

struct MotionFit {
  LearnedMotion model;
  int fixes = 0;     // that it is based on
  double nis = 2.0;  // mean normalised innovation squared: 2 where the model is true
};

/// The noise of the sensors and the process noise of the classes that make what the tracks were
/// given likeliest:
///   ln p = −½ Σ (ln 2 π S + r² / S)   over innovations r and their variances S, on each axis
/// maximised by parabolas, a parameter at a time, in logarithms. Intervals are from the curvature
/// there.
/// @param start     where to begin; what is given in it stays
/// @param interval  typical time between two detections of a target [s]
/// @param first     whether `start` may be far off
MotionFit fit_motion(std::span<const Path> paths, const LearnedMotion& start, double interval,
                     bool first);

}  // namespace ghtrack

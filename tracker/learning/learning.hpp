#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/learning/motion_fit.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// What somebody says of a sensor. What is absent is learned.
struct SensorSaid {
  double period = 1.0;                   // time between two looks at the same place [s]
  std::optional<Eigen::Vector2d> noise;  // 1-sigma error of a detection on each axis [m]
  FieldOfView field_of_view;
  std::optional<double> detection_probability;
  std::optional<double> clutter;  // expected false detections in one look at all of the view
  double area = std::numeric_limits<double>::infinity();  // of the view if it has no shape [m²]
  Coverage coverage = Coverage::kWhole;
};

struct LearnedSensor {
  LearnedMotion::Noise noise;
  Learned detection_probability;
  Learned clutter;
  SensorTraits traits;  // with all of that
  double area = 0.0;    // that false detections are spread over if the view has no shape [m²]
};

struct LearnedClass {
  Learned process_density;  // white noise in the acceleration [m²/s³]
  FilterConfig filter;
  double gain = 0.0;  // of that filter, in ln p, over one of constant velocity
  int tracks = 0;
};

/// A tracker for data that nobody has described, and how it fits them.
struct LearnedTracker {
  TrackerConfig config;
  std::vector<LearnedSensor> sensors;
  std::map<std::string, LearnedClass> classes;  // none if the filters are given
  double initial_speed = 0.0;                   // [m/s]
  double explained = 0.0;                       // share of the detections that tracks were given
  int tracks = 0;                               // that it was learned from
  int scans = 0;                                // the same
  int passes = 0;                               // how often the tracker ran over them
};

/// Learns what is not said from recorded scans, without units: if all places and times were
/// multiplied by constants, the result would be the same multiplied by them.
///
/// first_guess() finds the scales. From there on the tracker itself runs over the scans again and
/// again; after each pass what its surest tracks were given says how well the sensors see and how
/// the targets move (fit_motion()), how often targets are missed, and what is left over how many
/// detections are false. The numbers with the greatest likelihood, as the tracker computes it, are
/// kept. At the end each class gets the filter that makes its tracks likeliest (choose_filter()).
/// @param scans  by time; the covariance of a detection is zero where the data don't say it
LearnedTracker learn(const TrackerConfig& config, std::span<const SensorSaid> sensors,
                     std::span<const Scan> scans);

}  // namespace ghtrack

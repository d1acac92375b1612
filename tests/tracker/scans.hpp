#pragma once

#include <Eigen/Core>
#include <vector>

#include "tracker/tracker.hpp"

namespace ghtrack::testing {

/// What the first sensor saw at these places, with an error of `sigma` per axis [m].
inline Scan scan_of(double time, const std::vector<Eigen::Vector2d>& positions, double sigma) {
  Scan scan{.time = time, .sensor = 0, .detections = {}};
  for (const Eigen::Vector2d& position : positions) {
    scan.detections.push_back({.position = position,
                               .covariance = sigma * sigma * Eigen::Matrix2d::Identity(),
                               .label = {}});
  }
  return scan;
}

/// A tracker that is told the truth of a sensor with an error of 1 m a second, which sees a square
/// with a corner at the origin, and of targets that hardly change their velocity.
inline TrackerDesign told_design(Association association, double side, double detection_probability,
                                 double clutter) {
  TrackerConfig config;
  config.association = association;
  KalmanCvConfig filter;
  filter.model = process::WhiteNoise<1>{.spectral_density = 0.02};
  filter.initial_speed = 2.0;
  config.filters["default"] = filter;
  return {
      config,
      {{.period = 1.0,
        .sigma = 1.0,
        .field_of_view = Eigen::AlignedBox2d(Eigen::Vector2d(0, 0), Eigen::Vector2d(side, side)),
        .detection_probability = detection_probability,
        .clutter = clutter}}};
}

}  // namespace ghtrack::testing

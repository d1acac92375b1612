#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracker/filters/gains/gains.hpp"

namespace ghtrack {

enum class TrackStatus { kTentative, kConfirmed, kCoasting };

constexpr std::string_view to_string(TrackStatus status) {
  switch (status) {
    case TrackStatus::kTentative:
      return "tentative";
    case TrackStatus::kConfirmed:
      return "confirmed";
    case TrackStatus::kCoasting:
      return "coasting";
  }
  return "";
}

/// What the tracker says of one target after a scan. World frame, SI units.
struct TrackEstimate {
  int id = 0;  // counts from 1 in the order of birth; never used twice
  TrackStatus status = TrackStatus::kTentative;
  std::string filter;  // name of the filter that leads, such as "gh"
  std::string model;   // of several filters side by side, the leading one's, such as "ball"
  std::string label;   // class reported by the detections; empty if none
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
  Eigen::Vector2d prior_position = Eigen::Vector2d::Zero();  // before this scan's detection
  std::optional<Eigen::Vector2d> residual;                   // absent when no detection was used
  std::optional<std::size_t> detection;                      // index in the scan, when one was used
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();           // predicted 1-sigma position error [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // predicted, of the position's error [m²]
  Eigen::Matrix2d innovation_covariance = Eigen::Matrix2d::Zero();  // of the prior's residual [m²]

  // What the filter's closed forms say of its error: the noise that remains when the target moves
  // as the filter assumes. Where the target does not, a filter with designed gains lags behind; a
  // Kalman filter counts manoeuvres as noise.
  Gains gains;                                            // in the steady state
  Eigen::Vector2d noise_sigma = Eigen::Vector2d::Zero();  // [m]
  bool lags = false;                                      // noise_sigma tells the noise alone
};

/// All tracks after one scan.
struct TrackSnapshot {
  double time = 0.0;  // [s]
  int sensor = 0;
  std::vector<TrackEstimate> tracks;
};

}  // namespace ghtrack

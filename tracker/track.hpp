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

/// The latest update of a filter with designed gains.
struct DesignedStep {
  Gains gains;                                               // that it used
  double interval = 1.0;                                     // T by which they were divided [s]
  Eigen::Vector2d noise_velocity = Eigen::Vector2d::Zero();  // 1-sigma noise of the velocity [m/s]
};

/// What the tracker says of one target after a scan. World frame, SI units.
struct TrackEstimate {
  int id = 0;  // counts from 1 in the order of birth, or where existence is weighed of
               // confirmation, until which it is negative; never used twice
  std::optional<int> tentative_id;  // the negative one, once it is confirmed, too
  TrackStatus status = TrackStatus::kTentative;
  std::optional<double> existence;  // probability that there is a target; absent: it is not weighed
  std::string filter;               // name of the filter that leads, such as "gh"
  std::string model;  // of several filters side by side, the leading one's, such as "ball"
  std::string label;  // class reported by the detections; empty if none
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
  Eigen::Vector2d prior_position = Eigen::Vector2d::Zero();  // before this scan's detection
  std::optional<Eigen::Vector2d> residual;                   // absent when no detection was used
  std::optional<double> nis;                                 // normalised innovation squared of it
  std::optional<std::size_t> detection;                      // index in the scan, when one was used
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();           // predicted 1-sigma position error [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // predicted, of the position's error [m²]
  Eigen::Matrix2d innovation_covariance = Eigen::Matrix2d::Zero();  // of the prior's residual [m²]

  // What the filter says of the noise in its estimate: what remains of the error when the target
  // moves as the filter assumes. A Kalman filter counts manoeuvres as noise; one with designed
  // gains lags behind them.
  std::optional<Gains> gains;  // in the steady state, if the filter settles
  Eigen::Vector2d noise_sigma = Eigen::Vector2d::Zero();  // [m]
  std::optional<DesignedStep> designed;
};

/// All tracks after one scan.
struct TrackSnapshot {
  double time = 0.0;  // [s]
  int sensor = 0;
  bool weighs_existence = false;  // or counts hits and misses
  std::vector<TrackEstimate> tracks;
};

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "tracker/filters/filter_config.hpp"
#include "tracker/filters/kinematics.hpp"

namespace ghtrack {

/// One moment of a track: a measured position, or none.
struct TimedPosition {
  double time = 0.0;                                         // [s]
  std::optional<Eigen::Vector2d> position;                   // [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  // of its error [m²]
};

/// What is known of a moment afterwards.
struct Smoothed {
  Kinematics<2> state;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the position [m²]
};

/// Follows a track with all measurements, later ones included (Rauch, Tung & Striebel 1965):
/// forward the filter, then backward
///   G = C P'⁻¹,  x_s = x + G (x_s' − x'),  P_s = P + G (P_s' − P') Gᵀ
/// with C the covariance of the state with its prediction x', P'. Filters with designed gains are
/// smoothed as the Kalman filter whose process noise their gains imply (equivalent_motion()): the
/// two passes of a g-h filter.
/// @param track  in the order of time; moments before its first position are left as they are
/// @param sigma, dt  as for make_filter()
/// @param lag    how many moments later a measurement may be to count; nothing: all of them
std::vector<Smoothed> smoothed(const SingleFilterConfig& config, double sigma, double dt,
                               std::span<const TimedPosition> track,
                               std::optional<int> lag = std::nullopt);

/// ln p of the positions given each one's forerunners, as the filter sees them: which of several
/// filters explains a track best.
double log_likelihood(const SingleFilterConfig& config, double sigma, double dt,
                      std::span<const TimedPosition> track);

}  // namespace ghtrack

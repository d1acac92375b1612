#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/association.hpp"

namespace ghtrack {

/// Where a track expects its next detection, before the sensor's own error is counted.
struct Prediction {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    // [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the predicted position [m²]
};

/// Are the position and its covariance finite, and the covariance positive definite?
bool is_usable(const Detection& detection);

/// Mahalanobis distance of a detection from a prediction: √(rᵀ S⁻¹ r), S = P + R.
double mahalanobis_distance(const Prediction& prediction, const Detection& detection);

/// Finds the detections of a scan that lie near a place without looking at all of them: a uniform
/// grid over the scan, about one detection per cell.
class DetectionGrid {
 public:
  /// Keeps a view of the detections. Those that are not usable are never found.
  explicit DetectionGrid(std::span<const Detection> detections);

  /// Appends the row of a track: every detection that is not taken and whose Mahalanobis distance
  /// from the prediction is at most `gate`, in the order of the scan. The distance is the cost.
  void append_candidates(const Prediction& prediction, double gate, const std::vector<bool>& taken,
                         CandidateTable& table) const;

 private:
  int column_of(double x) const;
  int row_of(double y) const;

  std::span<const Detection> detections_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  // lower left
  Eigen::Vector2d cells_per_metre_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d largest_variance_ = Eigen::Vector2d::Zero();  // of any detection, per axis
  int columns_ = 1;
  int rows_ = 1;
  std::vector<int> cell_start_;  // of each cell, in members_
  std::vector<int> members_;     // detections, cell by cell
};

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/association.hpp"

namespace ghtrack {

/// Where a track expects its next detection, without the error of the sensor. @ingroup association
struct Prediction {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    // [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the predicted position [m²]
};

/// Are the position and its covariance finite, and the covariance positive definite?
bool is_usable(const Detection& detection);

/// Mahalanobis distance of a detection from a prediction: √(rᵀ S⁻¹ r), S = P + R.
double mahalanobis_distance(const Prediction& prediction, const Detection& detection);

/// The usable detections of a scan, in an order of their places that does not depend on the order
/// of the scan, and a uniform grid over them, about one per cell, that finds those near a place
/// without looking at all of them.
class DetectionGrid {
 public:
  /// What a tracker needs of a detection, side by side in memory with its neighbours.
  struct Member {
    Eigen::Vector2d position;
    Eigen::Matrix2d covariance;
    int detection;  // index in the scan
  };

  explicit DetectionGrid(std::span<const Detection> detections);

  const std::vector<Member>& members() const { return members_; }

  /// Appends the row of a track: every member whose Mahalanobis distance from the prediction is at
  /// most `gate`, in the order of the members. The distance is the cost.
  void append_row(const Prediction& prediction, double gate, CandidateTable& table) const;

 private:
  int column_of(double x) const;
  int row_of(double y) const;

  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  // lower left
  Eigen::Vector2d cells_per_metre_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d largest_variance_ = Eigen::Vector2d::Zero();  // of any member, per axis
  int columns_ = 1;
  int rows_ = 1;
  std::vector<int> cell_start_;  // of each cell, in members_
  std::vector<Member> members_;  // cell by cell
};

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/association.hpp"
#include "tracker/nearest_tree.hpp"
#include "tracker/prediction.hpp"

namespace ghtrack {

/// Are the position and its covariance finite, and the covariance positive definite?
bool is_usable(const Detection& detection);

/// Mahalanobis distance of a detection from a prediction: √(rᵀ S⁻¹ r), S = P + R.
double mahalanobis_distance(const Prediction& prediction, const Detection& detection);

/// The usable detections of a scan, in an order of their places that does not depend on the order
/// of the scan, and a uniform grid over them, about one per cell, that finds those near a place
/// without looking at all of them.
class DetectionGrid {
 public:
  using Member = PlacedDetection;

  /// A track among more detections than this chooses among the nearest: what lies as close as that
  /// no sensor tells apart. It bounds the work and the memory of a scan.
  static constexpr std::size_t kMostInGate = 32;

  explicit DetectionGrid(std::span<const Detection> detections);

  const std::vector<Member>& members() const { return members_; }

  /// The members in a track's gate, in their order; of a crowd the kMostInGate nearest.
  void find_in_gate(const Prediction& prediction, double gate, std::vector<Gated>& found);

  /// Appends the row of a track: every member whose Mahalanobis distance from the prediction is at
  /// most `gate`, in the order of the members. The distance is the cost.
  void append_row(const Prediction& prediction, double gate, CandidateTable& table);

 private:
  int column_of(double x) const;
  int row_of(double y) const;

  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  // lower left
  Eigen::Vector2d cells_per_metre_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d largest_variance_ = Eigen::Vector2d::Zero();  // of any member, per axis
  int columns_ = 1;
  int rows_ = 1;
  std::vector<int> cell_start_;       // of each cell, in members_
  std::vector<Member> members_;       // cell by cell
  std::optional<NearestTree> crowd_;  // of all members, once a gate has met a crowd
};

}  // namespace ghtrack

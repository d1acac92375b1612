#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tracker/prediction.hpp"

namespace ghtrack {

/// rᵀ adj(S) r and det S, whose quotient is the squared Mahalanobis distance.
struct InnovationQuotient {
  double numerator;
  double determinant;

  InnovationQuotient(const Prediction& prediction, const Eigen::Vector2d& position,
                     const Eigen::Matrix2d& covariance) {
    const Eigen::Vector2d residual = position - prediction.position;
    const Eigen::Matrix2d s = prediction.covariance + covariance;
    determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
    numerator = s(1, 1) * residual.x() * residual.x() -
                (s(0, 1) + s(1, 0)) * residual.x() * residual.y() +
                s(0, 0) * residual.y() * residual.y();
  }
  double squared_distance() const { return numerator / determinant; }
};

/// A detection in a track's gate.
struct Gated {
  int member = 0;                 // of the grid
  double squared_distance = 0.0;  // Mahalanobis: rᵀ S⁻¹ r
  double determinant = 0.0;       // of S [m⁴]
};

/// A k-d tree over detections that finds the nearest few to a prediction, by Mahalanobis distance,
/// without looking at the others; for crowds, of which a grid's cells may hold thousands.
class NearestTree {
 public:
  explicit NearestTree(const std::vector<PlacedDetection>& members);

  /// The `most` nearest members in the gate, in their order; of equally near ones the first.
  /// @param members  that the tree was made of
  void find_nearest(const std::vector<PlacedDetection>& members, const Prediction& prediction,
                    double gate, std::size_t most, std::vector<Gated>& found) const;

 private:
  struct Node {
    Eigen::Vector2d centre, half;  // of the box that holds its members [m]
    int begin, end;                // in order_
    int left = 0, right = 0;       // children; 0: it has none
  };
  class Query;

  int build(const std::vector<PlacedDetection>& members, int begin, int end);

  std::vector<int> order_;  // of the members, leaf by leaf
  std::vector<Node> nodes_;
  double greatest_variance_ = 0.0;  // of any member in any direction [m²]
};

}  // namespace ghtrack

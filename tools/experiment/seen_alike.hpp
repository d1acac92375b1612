#pragma once

#include <Eigen/Core>
#include <vector>

#include "tools/experiment/labelled_objects.hpp"
#include "tracker/filters/gain_filter.hpp"

namespace ghtrack {

/// Objects, such as one in many runs, that are detected and missed at the same instants with the same
/// accuracy. A filter whose gains do not depend on what it measures answers all of them with the same
/// gains and lets the same noise through: what differs is its lag, a linear recursion that goes
/// through all objects at once.
class SeenAlike {
 public:
  /// @param objects  equal in times, misses and covariances
  explicit SeenAlike(const std::vector<const LabelledObject*>& objects);

  /// Expected squares of the position's error over all measurement noise, of errors with the
  /// covariance that detections tell; over the scans from the third detection on [m²].
  /// @param filter  has not started yet, and no Huber limit
  Mean expected_squares(GainFilter<2> filter) const;

 private:
  const LabelledObject& first_;
  Eigen::Index count_;
  Eigen::ArrayXXd places_;  // by scan (column): x of all objects, then y [m]
};

/// The objects sorted into such groups, in the order of their first ones.
std::vector<SeenAlike> seen_alike(const std::vector<const LabelledObject*>& objects);

}  // namespace ghtrack

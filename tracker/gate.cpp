#include "tracker/gate.hpp"

#include <algorithm>
#include <cmath>

namespace ghtrack {

bool is_usable(const Detection& detection) {
  const Eigen::Matrix2d& r = detection.covariance;
  return detection.position.allFinite() && r.allFinite() && r(0, 0) > 0.0 &&
         r(0, 0) * r(1, 1) > r(0, 1) * r(1, 0);
}

double mahalanobis_distance(const Prediction& prediction, const Detection& detection) {
  const Eigen::Vector2d residual = detection.position - prediction.position;
  const Eigen::Matrix2d s = prediction.covariance + detection.covariance;
  const double determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
  const double squared =
      (s(1, 1) * residual.x() * residual.x() - (s(0, 1) + s(1, 0)) * residual.x() * residual.y() +
       s(0, 0) * residual.y() * residual.y()) /
      determinant;
  return std::sqrt(squared);
}

DetectionGrid::DetectionGrid(std::span<const Detection> detections) : detections_(detections) {
  std::vector<int> usable;
  for (int i = 0; i < static_cast<int>(detections.size()); ++i) {
    if (is_usable(detections[i])) usable.push_back(i);
  }
  if (usable.empty()) return;
  corner_ = detections[usable.front()].position;
  Eigen::Vector2d opposite = corner_;
  for (const int i : usable) {
    corner_ = corner_.cwiseMin(detections[i].position);
    opposite = opposite.cwiseMax(detections[i].position);
    largest_variance_ = largest_variance_.cwiseMax(detections[i].covariance.diagonal());
  }
  const int side = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(usable.size()))));
  columns_ = side;
  rows_ = side;
  const Eigen::Vector2d extent = opposite - corner_;
  for (int axis = 0; axis < 2; ++axis) {
    cells_per_metre_[axis] = extent[axis] > 0.0 ? side / extent[axis] : 0.0;
  }

  const auto cell_of = [&](int i) {
    const Eigen::Vector2d& p = detections_[i].position;
    return row_of(p.y()) * columns_ + column_of(p.x());
  };
  cell_start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const int i : usable) ++cell_start_[cell_of(i) + 1];
  for (std::size_t cell = 1; cell < cell_start_.size(); ++cell) {
    cell_start_[cell] += cell_start_[cell - 1];
  }
  members_.resize(usable.size());
  std::vector<int> next(cell_start_.begin(), cell_start_.end() - 1);
  for (const int i : usable) members_[next[cell_of(i)]++] = i;
}

int DetectionGrid::column_of(double x) const {
  return static_cast<int>(
      std::clamp((x - corner_.x()) * cells_per_metre_.x(), 0.0, columns_ - 1.0));
}

int DetectionGrid::row_of(double y) const {
  return static_cast<int>(std::clamp((y - corner_.y()) * cells_per_metre_.y(), 0.0, rows_ - 1.0));
}

void DetectionGrid::append_candidates(const Prediction& prediction, double gate,
                                      const std::vector<bool>& taken, CandidateTable& table) const {
  if (members_.empty() || !prediction.position.allFinite()) return;
  // The ellipse rᵀ S⁻¹ r ≤ gate² reaches gate √S_xx along x, gate √S_yy along y.
  const Eigen::Vector2d reach =
      gate * (prediction.covariance.diagonal() + largest_variance_).cwiseSqrt();
  const Eigen::Vector2d low = prediction.position - reach;
  const Eigen::Vector2d high = prediction.position + reach;
  const int first_column = column_of(low.x());
  const int last_column = column_of(high.x());
  const auto first_candidate = table.candidates.size();
  for (int row = row_of(low.y()); row <= row_of(high.y()); ++row) {
    const int begin = cell_start_[row * columns_ + first_column];
    const int end = cell_start_[row * columns_ + last_column + 1];
    for (int i = begin; i < end; ++i) {
      const int member = members_[i];
      if (taken[member]) continue;
      const double distance = mahalanobis_distance(prediction, detections_[member]);
      if (distance <= gate) table.candidates.push_back({member, distance});
    }
  }
  std::sort(table.candidates.begin() + static_cast<std::ptrdiff_t>(first_candidate),
            table.candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.detection < b.detection; });
}

}  // namespace ghtrack

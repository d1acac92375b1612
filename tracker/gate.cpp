#include "tracker/gate.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ghtrack {

bool is_usable(const Detection& detection) {
  const Eigen::Matrix2d& r = detection.covariance;
  return detection.position.allFinite() && r.allFinite() && r(0, 0) > 0.0 &&
         r(0, 0) * r(1, 1) > r(0, 1) * r(1, 0);
}

namespace {

/// So many members about a gate are not looked at one by one.
constexpr std::size_t kCrowd = 256;

/// What lies outside belongs to the outermost cells; what is not a number, as the place of an
/// infinite extent, to the first.
int cell_at(double place, int cells) {
  if (!(place > 0.0)) return 0;
  return place < cells ? static_cast<int>(place) : cells - 1;
}

}  // namespace

double mahalanobis_distance(const Prediction& prediction, const Detection& detection) {
  const InnovationQuotient quotient(prediction, detection.position, detection.covariance);
  return std::sqrt(quotient.squared_distance());
}

DetectionGrid::DetectionGrid(std::span<const Detection> detections) {
  // Detections are large: they are read once, and what is needed of them is put side by side.
  std::vector<Member> usable;
  usable.reserve(detections.size());
  for (int i = 0; i < static_cast<int>(detections.size()); ++i) {
    const Detection& detection = detections[i];
    if (is_usable(detection)) usable.push_back({detection.position, detection.covariance, i});
  }
  if (usable.empty()) return;
  corner_ = usable.front().position;
  Eigen::Vector2d opposite = corner_;
  for (const Member& member : usable) {
    corner_ = corner_.cwiseMin(member.position);
    opposite = opposite.cwiseMax(member.position);
    largest_variance_ = largest_variance_.cwiseMax(member.covariance.diagonal());
  }
  const int side = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(usable.size()))));
  columns_ = side;
  rows_ = side;
  const Eigen::Vector2d extent = opposite - corner_;
  for (int axis = 0; axis < 2; ++axis) {
    cells_per_metre_[axis] = extent[axis] > 0.0 ? side / extent[axis] : 0.0;
  }

  std::vector<int> cells;
  cells.reserve(usable.size());
  cell_start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Member& member : usable) {
    const Eigen::Vector2d& p = member.position;
    cells.push_back(row_of(p.y()) * columns_ + column_of(p.x()));
    ++cell_start_[cells.back() + 1];
  }
  for (std::size_t cell = 1; cell < cell_start_.size(); ++cell) {
    cell_start_[cell] += cell_start_[cell - 1];
  }
  members_.resize(usable.size());
  std::vector<int> next(cell_start_.begin(), cell_start_.end() - 1);
  for (std::size_t i = 0; i < usable.size(); ++i) members_[next[cells[i]]++] = usable[i];
  for (std::size_t cell = 1; cell < cell_start_.size(); ++cell) {
    std::sort(members_.begin() + cell_start_[cell - 1], members_.begin() + cell_start_[cell],
              [](const Member& a, const Member& b) {
                return std::tuple(a.position.x(), a.position.y(), a.detection) <
                       std::tuple(b.position.x(), b.position.y(), b.detection);
              });
  }
}

int DetectionGrid::column_of(double x) const {
  return cell_at((x - corner_.x()) * cells_per_metre_.x(), columns_);
}

int DetectionGrid::row_of(double y) const {
  return cell_at((y - corner_.y()) * cells_per_metre_.y(), rows_);
}

void DetectionGrid::find_in_gate(const Prediction& prediction, double gate,
                                 std::vector<Gated>& found) {
  found.clear();
  if (members_.empty() || !prediction.position.allFinite()) return;
  // The ellipse rᵀ S⁻¹ r ≤ gate² reaches gate √S_xx along x, gate √S_yy along y.
  const Eigen::Vector2d reach =
      gate * (prediction.covariance.diagonal() + largest_variance_).cwiseSqrt();
  const Eigen::Vector2d low = prediction.position - reach;
  const Eigen::Vector2d high = prediction.position + reach;
  const int first_column = column_of(low.x());
  const int last_column = column_of(high.x());
  const int last_row = row_of(high.y());
  std::size_t near = 0;
  for (int row = row_of(low.y()); row <= last_row; ++row) {
    near += static_cast<std::size_t>(cell_start_[row * columns_ + last_column + 1] -
                                     cell_start_[row * columns_ + first_column]);
  }
  if (near > kCrowd) {
    if (!crowd_) crowd_.emplace(members_);
    crowd_->find_nearest(members_, prediction, gate, kMostInGate, found);
    return;
  }
  const double surely_outside = 1.0001 * gate * gate;  // spares a division and a root
  for (int row = row_of(low.y()); row <= last_row; ++row) {
    const int end = cell_start_[row * columns_ + last_column + 1];
    for (int i = cell_start_[row * columns_ + first_column]; i < end; ++i) {
      const InnovationQuotient quotient(prediction, members_[i].position, members_[i].covariance);
      if (quotient.numerator > surely_outside * quotient.determinant) continue;
      const double squared_distance = quotient.squared_distance();
      if (!(std::sqrt(squared_distance) <= gate)) continue;
      found.push_back({i, squared_distance, quotient.determinant});
    }
  }
}

void DetectionGrid::append_row(const Prediction& prediction, double gate, CandidateTable& table) {
  std::vector<Gated> found;
  find_in_gate(prediction, gate, found);
  for (const Gated& gated : found) {
    table.candidates.push_back({gated.member, std::sqrt(gated.squared_distance)});
  }
  table.close_row();
}

}  // namespace ghtrack

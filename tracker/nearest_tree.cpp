#include "tracker/nearest_tree.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ghtrack {
namespace {

constexpr int kLeaf = 16;

double greater_eigenvalue(const Eigen::Matrix2d& m) {
  const double mean = 0.5 * (m(0, 0) + m(1, 1));
  const double half = 0.5 * (m(0, 0) - m(1, 1));
  return mean + std::sqrt(half * half + m(0, 1) * m(0, 1));
}

bool is_nearer(const Gated& a, const Gated& b) {
  return std::pair(a.squared_distance, a.member) < std::pair(b.squared_distance, b.member);
}

}  // namespace

NearestTree::NearestTree(const std::vector<PlacedDetection>& members) : order_(members.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  for (const PlacedDetection& member : members) {
    greatest_variance_ = std::max(greatest_variance_, greater_eigenvalue(member.covariance));
  }
  if (!members.empty()) build(members, 0, static_cast<int>(members.size()));
}

int NearestTree::build(const std::vector<PlacedDetection>& members, int begin, int end) {
  const auto first = order_.begin() + begin;
  const auto last = order_.begin() + end;
  Eigen::Vector2d low = members[*first].position;
  Eigen::Vector2d high = low;
  for (auto it = first; it != last; ++it) {
    low = low.cwiseMin(members[*it].position);
    high = high.cwiseMax(members[*it].position);
  }
  const auto index = static_cast<int>(nodes_.size());
  nodes_.push_back({.centre = 0.5 * low + 0.5 * high,
                    .half = 0.5 * high - 0.5 * low,
                    .begin = begin,
                    .end = end});
  if (end - begin <= kLeaf || low == high) {
    std::sort(first, last);
    return index;
  }
  const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
  const int middle = begin + (end - begin) / 2;
  std::nth_element(first, order_.begin() + middle, last, [&](int a, int b) {
    return std::pair(members[a].position[axis], a) < std::pair(members[b].position[axis], b);
  });
  const int left = build(members, begin, middle);
  const int right = build(members, middle, end);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

/// The nearest few so far, the farthest of them on top of a heap.
class NearestTree::Query {
 public:
  Query(const NearestTree& tree, const std::vector<PlacedDetection>& members,
        const Prediction& prediction, double gate, std::size_t most, std::vector<Gated>& found)
      : tree_(tree),
        members_(members),
        prediction_(prediction),
        gate_(gate),
        most_(most),
        found_(found) {
    // What a box holds is no nearer than its centre less its radius, by the widest covariance.
    const Eigen::Matrix2d widest =
        prediction.covariance + tree.greatest_variance_ * Eigen::Matrix2d::Identity();
    inverse_ = widest.inverse();
    stretch_ = std::sqrt(greater_eigenvalue(inverse_));
  }

  void visit(int index) {
    const Node& node = tree_.nodes_[index];
    if (!can_hold_nearer(node)) return;
    if (node.right == 0) {
      look_at(node);
      return;
    }
    const bool left_first = bound(tree_.nodes_[node.left]) <= bound(tree_.nodes_[node.right]);
    visit(left_first ? node.left : node.right);
    visit(left_first ? node.right : node.left);
  }

 private:
  double bound(const Node& node) const {
    const Eigen::Vector2d offset = node.centre - prediction_.position;
    const double centre = std::sqrt(std::max(0.0, offset.dot(inverse_ * offset)));
    return std::max(0.0, centre - stretch_ * node.half.norm());
  }

  bool can_hold_nearer(const Node& node) const {
    const double least = bound(node);
    if (least > gate_) return false;
    return found_.size() < most_ || least * least < found_.front().squared_distance;
  }

  void look_at(const Node& node) {
    // Of members in one place the first few are as good as all.
    const bool is_point = node.half.isZero(0.0);
    const int end = is_point ? std::min(node.end, node.begin + static_cast<int>(most_)) : node.end;
    for (int i = node.begin; i < end; ++i) {
      const PlacedDetection& member = members_[tree_.order_[i]];
      const InnovationQuotient quotient(prediction_, member.position, member.covariance);
      const Gated gated{tree_.order_[i], quotient.squared_distance(), quotient.determinant};
      if (!(std::sqrt(gated.squared_distance) <= gate_)) continue;
      if (found_.size() == most_) {
        if (!is_nearer(gated, found_.front())) continue;
        std::pop_heap(found_.begin(), found_.end(), is_nearer);
        found_.pop_back();
      }
      found_.push_back(gated);
      std::push_heap(found_.begin(), found_.end(), is_nearer);
    }
  }

  const NearestTree& tree_;
  const std::vector<PlacedDetection>& members_;
  const Prediction& prediction_;
  double gate_;
  std::size_t most_;
  std::vector<Gated>& found_;
  Eigen::Matrix2d inverse_;
  double stretch_ = 0.0;
};

void NearestTree::find_nearest(const std::vector<PlacedDetection>& members,
                               const Prediction& prediction, double gate, std::size_t most,
                               std::vector<Gated>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  Query(*this, members, prediction, gate, most, found).visit(0);
  std::sort(found.begin(), found.end(),
            [](const Gated& a, const Gated& b) { return a.member < b.member; });
}

}  // namespace ghtrack

#include "sim/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace ghtrack {
namespace {

/// Disjoint sets with path halving; the smallest index represents its set.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::size_t> parent_;
};

bool may_meet(const SweptBox& a, const SweptBox& b) {
  return (a.yields || b.yields) && a.owner != b.owner && a.carrier != b.owner &&
         b.carrier != a.owner;
}

/// Rows across the plane, twice as high as a box is on average, so that together the boxes lie in at
/// most two and a half times as many rows as there are boxes.
class Rows {
 public:
  explicit Rows(const std::vector<SweptBox>& boxes) {
    double heights = 0.0;
    for (const SweptBox& box : boxes) heights += box.high.y() - box.low.y();
    const double height = 2.0 * heights / static_cast<double>(boxes.size());
    if (std::isfinite(height) && height > 0.0) height_ = height;
  }

  std::int64_t of(double y) const {
    constexpr double kLast = 1e15;
    const double row = std::floor(y / height_);
    return std::isfinite(row) ? static_cast<std::int64_t>(std::clamp(row, -kLast, kLast)) : 0;
  }

 private:
  double height_ = 1.0;  // [m]
};

/// Pairs of boxes that overlap and may meet, by sweep and prune along x in each row, so that the cost
/// grows with the number of boxes and not with its square, however they are arranged.
std::vector<std::pair<std::size_t, std::size_t>> overlapping_pairs(
    const std::vector<SweptBox>& boxes) {
  struct Entry {  // side by side in memory: most comparisons fail
    std::int64_t row, lowest_row;
    double left, right, bottom, top;
    std::size_t box;
  };
  const Rows rows(boxes);
  std::vector<Entry> entries;
  entries.reserve(2 * boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec2& low = boxes[i].low;
    const Vec2& high = boxes[i].high;
    const std::int64_t lowest = rows.of(low.y());
    const std::int64_t highest = rows.of(high.y());
    for (std::int64_t row = lowest; row <= highest; ++row) {
      entries.push_back({row, lowest, low.x(), high.x(), low.y(), high.y(), i});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.row != b.row ? a.row < b.row : a.left < b.left;
  });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (auto one = entries.begin(); one != entries.end(); ++one) {
    for (auto other = one + 1;
         other != entries.end() && other->row == one->row && other->left <= one->right; ++other) {
      if (one->bottom > other->top || other->bottom > one->top) continue;
      if (std::max(one->lowest_row, other->lowest_row) != one->row) continue;  // met there before
      if (may_meet(boxes[one->box], boxes[other->box])) pairs.emplace_back(one->box, other->box);
    }
  }
  return pairs;
}

}  // namespace

std::vector<Cluster> find_clusters(const std::vector<SweptBox>& boxes) {
  const auto pairs = overlapping_pairs(boxes);
  if (pairs.empty()) return {};

  Sets sets(boxes.size());
  for (const auto& [a, b] : pairs) {
    if (boxes[a].yields && boxes[b].yields) sets.join(a, b);
  }
  std::map<std::size_t, Cluster> clusters;
  std::vector<bool> listed(boxes.size(), false);
  for (const auto& [a, b] : pairs) {
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
      if (!boxes[one].yields) continue;
      Cluster& cluster = clusters[sets.find(one)];
      if (!listed[one]) cluster.yielding.push_back(one);
      listed[one] = true;
      if (!boxes[other].yields) cluster.unyielding.push_back(other);
    }
  }
  std::vector<Cluster> result;
  for (auto& [representative, cluster] : clusters) {
    std::sort(cluster.unyielding.begin(), cluster.unyielding.end());
    cluster.unyielding.erase(std::unique(cluster.unyielding.begin(), cluster.unyielding.end()),
                             cluster.unyielding.end());
    result.push_back(std::move(cluster));
  }
  return result;
}

}  // namespace ghtrack

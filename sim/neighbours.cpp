#include "sim/neighbours.hpp"

#include <algorithm>
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

/// Pairs of boxes that overlap and may meet, by sweep and prune along x.
std::vector<std::pair<std::size_t, std::size_t>> overlapping_pairs(
    const std::vector<SweptBox>& boxes) {
  struct Entry {  // side by side in memory: most comparisons fail
    double left, right, bottom, top;
    std::size_t box;
  };
  std::vector<Entry> entries;
  entries.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec2& low = boxes[i].low;
    const Vec2& high = boxes[i].high;
    entries.push_back({low.x(), high.x(), low.y(), high.y(), i});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.left < b.left; });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (auto one = entries.begin(); one != entries.end(); ++one) {
    for (auto other = one + 1; other != entries.end() && other->left <= one->right; ++other) {
      if (one->bottom > other->top || other->bottom > one->top) continue;
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

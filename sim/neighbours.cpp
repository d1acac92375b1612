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
         b.carrier != a.owner && a.low.y() <= b.high.y() && b.low.y() <= a.high.y();
}

}  // namespace

std::vector<Cluster> find_clusters(const std::vector<SweptBox>& boxes) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return boxes[a].low.x() < boxes[b].low.x(); });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const SweptBox& box = boxes[order[i]];
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (boxes[order[j]].low.x() > box.high.x()) break;
      if (may_meet(box, boxes[order[j]])) pairs.emplace_back(order[i], order[j]);
    }
  }
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

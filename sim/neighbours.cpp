#include "sim/neighbours.hpp"

#include <box2d/b2_dynamic_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

bool overlap(const SweptBox& a, const SweptBox& b) {
  return a.low.x() <= b.high.x() && b.low.x() <= a.high.x() && a.low.y() <= b.high.y() &&
         b.low.y() <= a.high.y();
}

/// In single precision, rounded outwards; far beyond every scene if it is not finite.
float rounded(double x, float outwards) {
  constexpr double kFarthest = 1e12;
  const double clamped = std::isnan(x) ? 0.0 : std::clamp(x, -kFarthest, kFarthest);
  return std::nextafter(static_cast<float>(clamped),
                        outwards * std::numeric_limits<float>::infinity());
}

b2AABB box_of(const SweptBox& box) {
  b2AABB result;
  result.lowerBound = {rounded(box.low.x(), -1.0F), rounded(box.low.y(), -1.0F)};
  result.upperBound = {rounded(box.high.x(), 1.0F), rounded(box.high.y(), 1.0F)};
  return result;
}

}  // namespace

class Neighbourhood::Tree {
 public:
  /// Pairs of boxes, as indices, that overlap and may meet; ascending.
  std::vector<std::pair<std::size_t, std::size_t>> pairs(const std::vector<SweptBox>& boxes) {
    enter(boxes);
    find_new_pairs();
    std::vector<std::pair<std::size_t, std::size_t>> result;
    for (const auto& [first, second] : near_) {
      const std::ptrdiff_t one = bodies_[first].box;
      const std::ptrdiff_t other = bodies_[second].box;
      if (one < 0 || other < 0) continue;
      const auto [a, b] =
          std::minmax({static_cast<std::size_t>(one), static_cast<std::size_t>(other)});
      if (may_meet(boxes[a], boxes[b]) && overlap(boxes[a], boxes[b])) result.emplace_back(a, b);
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  // For b2DynamicTree::Query.
  bool QueryCallback(std::int32_t proxy) {
    const auto other =
        static_cast<std::size_t>(reinterpret_cast<std::uintptr_t>(tree_.GetUserData(proxy)));
    if (other == asking_ || (bodies_[other].moved && other < asking_)) return true;
    near_.emplace_back(asking_, other);
    return true;
  }

 private:
  struct Body {
    std::int32_t proxy = b2_nullNode;
    std::ptrdiff_t box = -1;  // its index in this step; −1: it is not there
    bool moved = false;       // out of its place in the tree
    b2Vec2 centre = b2Vec2_zero;
  };

  void enter(const std::vector<SweptBox>& boxes) {
    for (Body& body : bodies_) body.box = -1;
    moved_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::size_t number = boxes[i].body;
      if (number >= bodies_.size()) bodies_.resize(number + 1);
      Body& body = bodies_[number];
      body.box = static_cast<std::ptrdiff_t>(i);
      const b2AABB box = box_of(boxes[i]);
      const b2Vec2 centre = box.GetCenter();
      if (body.proxy == b2_nullNode) {
        body.proxy = tree_.CreateProxy(box, reinterpret_cast<void*>(number));
      } else if (!tree_.MoveProxy(body.proxy, box, foreseen(centre - body.centre))) {
        body.centre = centre;
        continue;
      }
      body.centre = centre;
      body.moved = true;
      moved_.push_back(number);
    }
  }

  /// The way that the tree makes room for, four times: what goes far comes again anyway.
  static b2Vec2 foreseen(const b2Vec2& way) {
    constexpr float kFar = 0.5F;  // [m]
    return way.LengthSquared() < kFar * kFar ? way : b2Vec2_zero;
  }

  void find_new_pairs() {
    if (moved_.empty()) return;
    std::erase_if(near_, [&](const std::pair<std::size_t, std::size_t>& pair) {
      return bodies_[pair.first].moved || bodies_[pair.second].moved;
    });
    for (const std::size_t number : moved_) {
      asking_ = number;
      tree_.Query(this, tree_.GetFatAABB(bodies_[number].proxy));
    }
    for (const std::size_t number : moved_) bodies_[number].moved = false;
  }

  b2DynamicTree tree_;
  std::vector<Body> bodies_;
  std::vector<std::size_t> moved_;
  std::vector<std::pair<std::size_t, std::size_t>> near_;  // with their margins
  std::size_t asking_ = 0;
};

Neighbourhood::Neighbourhood() : tree_(std::make_unique<Tree>()) {}
Neighbourhood::~Neighbourhood() = default;
Neighbourhood::Neighbourhood(Neighbourhood&&) noexcept = default;
Neighbourhood& Neighbourhood::operator=(Neighbourhood&&) noexcept = default;

std::vector<std::pair<std::size_t, std::size_t>> Neighbourhood::pairs(
    const std::vector<SweptBox>& boxes) {
  return tree_->pairs(boxes);
}

std::vector<Cluster> Neighbourhood::clusters(const std::vector<SweptBox>& boxes) {
  const auto pairs = tree_->pairs(boxes);
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

#include "sensors/merging.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace ghtrack {
namespace {

using Group = std::vector<std::size_t>;

/// Sets of indices that are linked directly or by others.
class Links {
 public:
  explicit Links(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

 private:
  std::vector<std::size_t> parent_;
};

Sighting merged(const std::vector<Sighting>& sightings, const Group& group) {
  Sighting result;
  result.detection.position.setZero();
  result.detection.covariance.setZero();
  for (const std::size_t i : group) {
    result.detection.position += sightings[i].detection.position;
    result.detection.covariance += sightings[i].detection.covariance;
  }
  result.detection.position /= static_cast<double>(group.size());
  result.detection.covariance /= static_cast<double>(group.size());
  const auto rank = [&](std::size_t i) {
    const Vec2 offset = sightings[i].detection.position - result.detection.position;
    return std::tuple(sightings[i].origin == kClutterOrigin, offset.squaredNorm(),
                      sightings[i].origin);
  };
  const std::size_t named = *std::min_element(
      group.begin(), group.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  result.origin = sightings[named].origin;
  result.detection.label = sightings[named].detection.label;
  return result;
}

}  // namespace

std::vector<Sighting> merge_close(std::vector<Sighting> sightings, double resolution) {
  std::sort(sightings.begin(), sightings.end(), [](const Sighting& a, const Sighting& b) {
    return a.detection.position.x() < b.detection.position.x();
  });
  Links links(sightings.size());
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    for (std::size_t j = i + 1; j < sightings.size(); ++j) {
      const Vec2 offset = sightings[j].detection.position - sightings[i].detection.position;
      if (offset.x() >= resolution) break;
      if (offset.norm() < resolution) links.join(i, j);
    }
  }
  std::map<std::size_t, Group> groups;
  for (std::size_t i = 0; i < sightings.size(); ++i) groups[links.root(i)].push_back(i);
  std::vector<Sighting> result;
  for (const auto& [root, group] : groups) {
    if (group.size() == 1) result.push_back(std::move(sightings[group.front()]));
    if (group.size() > 1) result.push_back(merged(sightings, group));
  }
  return result;
}

}  // namespace ghtrack

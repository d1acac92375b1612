#include "tools/render/label_layout.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace ghtrack::render {

namespace {

/// Directions from the anchor in order of preference: right, above, left, below and between.
struct Direction {
  double x, y;
};
constexpr std::array<Direction, 8> kDirections{
    {{1, -1}, {1, 0}, {1, 1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}}};
constexpr std::array<double, 4> kDistances{0.0, 1.0, 2.2, 3.6};  // in heights of the label

constexpr double kMoveCost = 0.6;  // from one side of the anchor to another
constexpr double kDistanceCost = 0.15;
constexpr double kDirectionCost = 0.02;

Viewport candidate(const LabelRequest& label, int slot) {
  const Direction direction = kDirections[static_cast<std::size_t>(slot) % kDirections.size()];
  const double distance =
      label.reach + kDistances[static_cast<std::size_t>(slot) / kDirections.size()] * label.height;
  const double x = label.anchor.x + direction.x * distance;
  const double y = label.anchor.y + direction.y * distance;
  return {x + 0.5 * (direction.x - 1.0) * label.width, y + 0.5 * (direction.y - 1.0) * label.height,
          label.width, label.height};
}

/// All places that a label may take lie in here.
Viewport reach_of(const LabelRequest& label) {
  const double far = label.reach + kDistances.back() * label.height;
  const double x = far + label.width;
  const double y = far + label.height;
  return {label.anchor.x - x, label.anchor.y - y, 2.0 * x, 2.0 * y};
}

bool lies_within(const Viewport& inner, const Viewport& outer) {
  return inner.left >= outer.left && inner.top >= outer.top && inner.right() <= outer.right() &&
         inner.bottom() <= outer.bottom();
}

}  // namespace

double overlap(const Viewport& first, const Viewport& second) {
  const double width = std::min(first.right(), second.right()) - std::max(first.left, second.left);
  const double height = std::min(first.bottom(), second.bottom()) - std::max(first.top, second.top);
  return width > 0.0 && height > 0.0 ? width * height : 0.0;
}

std::vector<std::optional<Viewport>> LabelLayout::place(const std::vector<LabelRequest>& requests,
                                                        const std::vector<Obstacle>& obstacles,
                                                        const Viewport& area) {
  std::map<int, int> slots;
  std::vector<std::optional<Viewport>> places;
  const int count = static_cast<int>(kDirections.size() * kDistances.size());
  for (const LabelRequest& request : requests) {
    const auto previous = slots_.find(request.id);
    double least = std::numeric_limits<double>::infinity();
    std::optional<Viewport> best;
    std::vector<Obstacle> near;
    for (const Obstacle& obstacle : obstacles)
      if (overlap(obstacle.box, reach_of(request)) > 0.0) near.push_back(obstacle);
    for (int slot = 0; slot < count; ++slot) {
      const Viewport place = candidate(request, slot);
      const auto is_taken = [&](const std::optional<Viewport>& other) {
        return other && overlap(place, *other) > 0.0;
      };
      if (!lies_within(place, area) || std::any_of(places.begin(), places.end(), is_taken))
        continue;
      double cost = kDirectionCost * (slot % static_cast<int>(kDirections.size())) +
                    kDistanceCost * (slot / static_cast<int>(kDirections.size()));
      if (previous != slots_.end() && previous->second != slot) cost += kMoveCost;
      for (const Obstacle& obstacle : near)
        if (const double hidden = overlap(place, obstacle.box); hidden > 0.0)
          cost += obstacle.cost * (1.0 + 5.0 * hidden / (request.width * request.height));
      if (!(cost < least)) continue;
      least = cost;
      best = place;
      slots[request.id] = slot;
    }
    places.push_back(best);
  }
  slots_ = std::move(slots);
  return places;
}

}  // namespace ghtrack::render

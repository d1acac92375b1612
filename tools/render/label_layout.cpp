#include "tools/render/label_layout.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

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

bool lies_within(const Viewport& inner, const Viewport& outer) {
  return inner.left >= outer.left && inner.top >= outer.top && inner.right() <= outer.right() &&
         inner.bottom() <= outer.bottom();
}

/// Rectangles by the squares of a picture that they touch, to be found without a look at all
/// others.
class Squares {
 public:
  explicit Squares(const Viewport& area)
      : area_(area), columns_(1 + last(area.width)), squares_(columns_ * (1 + last(area.height))) {}

  void add(std::size_t index, const Viewport& box) {
    each_square(box, [&](std::vector<std::size_t>& square) {
      square.push_back(index);
      return true;
    });
    if (index >= last_visit_.size()) last_visit_.resize(index + 1, 0);
  }

  /// Visits each rectangle that touches the squares of this one, once, as long as visit(index)
  /// wants more.
  template <class Visit>
  void each_near(const Viewport& box, const Visit& visit) {
    ++visits_;
    each_square(box, [&](const std::vector<std::size_t>& square) {
      return std::all_of(square.begin(), square.end(), [&](std::size_t index) {
        return std::exchange(last_visit_[index], visits_) == visits_ || visit(index);
      });
    });
  }

 private:
  static constexpr double kSide = 24.0;  // [px]

  static std::size_t last(double length) {
    return static_cast<std::size_t>(std::max(0.0, length) / kSide);
  }

  template <class Visit>
  void each_square(const Viewport& box, const Visit& visit) {
    if (!(overlap(box, area_) > 0.0)) return;
    const double top = std::max(box.top, area_.top);
    const double left = std::max(box.left, area_.left);
    const double bottom = std::min(box.bottom(), area_.bottom());
    const double right = std::min(box.right(), area_.right());
    for (std::size_t row = last(top - area_.top); row <= last(bottom - area_.top); ++row) {
      for (std::size_t i = last(left - area_.left); i <= last(right - area_.left); ++i) {
        if (!visit(squares_[row * columns_ + i])) return;
      }
    }
  }

  Viewport area_;
  std::size_t columns_;
  std::vector<std::vector<std::size_t>> squares_;
  std::vector<std::uint64_t> last_visit_;  // of each rectangle
  std::uint64_t visits_ = 0;
};

}  // namespace

double overlap(const Viewport& first, const Viewport& second) {
  const double width = std::min(first.right(), second.right()) - std::max(first.left, second.left);
  const double height = std::min(first.bottom(), second.bottom()) - std::max(first.top, second.top);
  return width > 0.0 && height > 0.0 ? width * height : 0.0;
}

std::vector<std::optional<Viewport>> LabelLayout::place(const std::vector<LabelRequest>& requests,
                                                        const std::vector<Obstacle>& obstacles,
                                                        const Viewport& area) {
  Squares obstacle_squares(area), label_squares(area);
  for (std::size_t i = 0; i < obstacles.size(); ++i) obstacle_squares.add(i, obstacles[i].box);
  std::map<int, int> slots;
  std::vector<std::optional<Viewport>> places;
  const int directions = static_cast<int>(kDirections.size());
  for (const LabelRequest& request : requests) {
    const auto is_taken = [&](const Viewport& place) {
      bool taken = false;
      label_squares.each_near(place, [&](std::size_t other) {
        taken = overlap(place, *places[other]) > 0.0;
        return !taken;
      });
      return taken;
    };
    const auto previous = slots_.find(request.id);
    double least = std::numeric_limits<double>::infinity();
    std::optional<Viewport> best;
    for (int slot = 0; slot < directions * static_cast<int>(kDistances.size()); ++slot) {
      const Viewport place = candidate(request, slot);
      double cost = kDirectionCost * (slot % directions) + kDistanceCost * (slot / directions);
      if (previous != slots_.end() && previous->second != slot) cost += kMoveCost;
      if (!(cost < least) || !lies_within(place, area) || is_taken(place)) continue;
      obstacle_squares.each_near(place, [&](std::size_t i) {
        const double hidden = overlap(place, obstacles[i].box);
        if (!(hidden > 0.0)) return true;
        cost += obstacles[i].cost * (1.0 + 5.0 * hidden / (request.width * request.height));
        return cost < least;
      });
      if (!(cost < least)) continue;
      least = cost;
      best = place;
      slots[request.id] = slot;
    }
    if (best) label_squares.add(places.size(), *best);
    places.push_back(best);
  }
  slots_ = std::move(slots);
  return places;
}

}  // namespace ghtrack::render

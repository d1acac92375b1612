#include "sim/passages.hpp"

#include <algorithm>
#include <optional>

#include "sim/plane.hpp"

namespace ghtrack {
namespace {

constexpr double kApart = 0.3;  // centre lines farther apart are those of two tracks [m]

/// The line from end to end of a car.
struct Axis {
  Vec2 rear;
  Vec2 front;
};

Axis axis_of(const RigidBody& car, double length) {
  const Vec2 half = 0.5 * length * direction(car.angle);
  return {car.position - half, car.position + half};
}

std::vector<Axis> axes_of(const TrainOnTrack& train) {
  const double length = train.model->contact().outline.length;
  std::vector<Axis> axes;
  for (int car = 0; car < train.model->bodies(); ++car) {
    axes.push_back(axis_of(train.model->body(*train.state, car), length));
  }
  return axes;
}

double distance(const Vec2& point, const Axis& axis) {
  const Vec2 along = axis.front - axis.rear;
  const double part = std::clamp((point - axis.rear).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - axis.rear - part * along).norm();
}

bool intersect(const Axis& a, const Axis& b) {
  const auto side = [](const Axis& axis, const Vec2& point) {
    return cross(axis.front - axis.rear, point - axis.rear);
  };
  return side(a, b.rear) * side(a, b.front) < 0.0 && side(b, a.rear) * side(b, a.front) < 0.0;
}

bool are_one(const Axis& a, const Axis& b) {
  return intersect(a, b) || std::min({distance(a.rear, b), distance(a.front, b),
                                      distance(b.rear, a), distance(b.front, a)}) < kApart;
}

/// The first cars of two trains that are in each other's place.
std::optional<Passage> passage_of(const TrainOnTrack& one, const TrainOnTrack& other) {
  const std::vector<Axis> ones = axes_of(one);
  const std::vector<Axis> others = axes_of(other);
  for (std::size_t i = 0; i < ones.size(); ++i) {
    for (std::size_t j = 0; j < others.size(); ++j) {
      if (!are_one(ones[i], others[j])) continue;
      return Passage{.car = static_cast<int>(i),
                     .other_car = static_cast<int>(j),
                     .position = 0.5 * (ones[i].rear + ones[i].front)};
    }
  }
  return std::nullopt;
}

/// Around all cars of a train, and no smaller than that.
SweptBox box_of(const TrainOnTrack& train, std::size_t index) {
  const double front = train.model->front(*train.state).place;
  const double rear = train.model->rear(*train.state).place;
  const Vec2 middle = train.model->track().at(0.5 * (front + rear)).position;
  const Vec2 reach = Vec2::Constant(0.5 * (front - rear) + kApart);
  return {static_cast<std::size_t>(train.number), middle - reach, middle + reach, true,
          static_cast<int>(index)};
}

}  // namespace

std::vector<Passage> PassageWatch::look(std::span<const TrainOnTrack> trains,
                                        std::span<const int> tracks) {
  std::vector<SweptBox> boxes;
  for (std::size_t i = 0; i < trains.size(); ++i) boxes.push_back(box_of(trains[i], i));
  std::vector<Passage> passages;
  for (const auto& [a, b] : neighbourhood_.pairs(boxes)) {
    if (tracks[a] == tracks[b] && !is_inside(trains[a], trains[b])) continue;
    const std::pair numbers(trains[a].number, trains[b].number);
    if (told_.contains(numbers)) continue;
    std::optional<Passage> passage = passage_of(trains[a], trains[b]);
    if (!passage) continue;
    passage->one = a;
    passage->other = b;
    told_.insert(numbers);
    passages.push_back(*passage);
  }
  return passages;
}

}  // namespace ghtrack

#include "tools/page/recording.hpp"

#include <memory>
#include <stdexcept>

namespace ghtrack::page {
namespace {

/// Takes numbers off the front.
class Numbers {
 public:
  explicit Numbers(std::span<const double> rest) : rest_(rest) {}

  bool is_empty() const { return rest_.empty(); }

  double take() {
    if (rest_.empty()) throw std::invalid_argument("the recorded truth ends too early");
    const double number = rest_.front();
    rest_ = rest_.subspan(1);
    return number;
  }
  Vec2 take_vector() {
    const double x = take();
    return {x, take()};
  }
  ObjectId take_id() { return static_cast<ObjectId>(take()); }
  std::size_t take_count() { return static_cast<std::size_t>(take()); }

 private:
  std::span<const double> rest_;
};

}  // namespace

std::vector<RecordedObject> to_recorded(const std::vector<ObjectInfo>& objects) {
  std::vector<RecordedObject> recorded;
  for (const ObjectInfo& object : objects) {
    RecordedObject& one = recorded.emplace_back();
    one.name = object.name;
    one.regime = object.regime;
    one.label = object.label;
    one.key = object.key;
    while (RecordedObject::kShapes.at(one.shape).second != object.outline.shape) ++one.shape;
    one.length = object.outline.length;
    one.width = object.outline.width;
  }
  return recorded;
}

std::vector<ObjectInfo> from_recorded(const std::vector<RecordedObject>& objects) {
  std::vector<ObjectInfo> result;
  for (const RecordedObject& one : objects) {
    result.push_back(
        {.id = static_cast<ObjectId>(result.size()),
         .name = one.name,
         .regime = one.regime,
         .label = one.label,
         .key = one.key,
         .outline = {RecordedObject::kShapes.at(one.shape).second, one.length, one.width}});
  }
  return result;
}

std::vector<double> to_numbers(const TruthRecording& truth) {
  std::vector<double> numbers;
  const auto add = [&](double number) { numbers.push_back(number); };
  const auto add_vector = [&](const Vec2& v) {
    add(v.x());
    add(v.y());
  };
  for (const auto& snapshot : truth.snapshots) {
    add(snapshot->time);
    add(static_cast<double>(snapshot->objects.size()));
    for (const TruthState& object : snapshot->objects) {
      add(object.id);
      add_vector(object.position);
      add_vector(object.velocity);
      add_vector(object.acceleration);
    }
    add(static_cast<double>(snapshot->bodies.size()));
    for (const BodyPose& body : snapshot->bodies) {
      add(body.id);
      add_vector(body.position);
      add(body.angle);
    }
  }
  return numbers;
}

std::vector<std::shared_ptr<const TruthSnapshot>> from_numbers(std::span<const double> numbers) {
  std::vector<std::shared_ptr<const TruthSnapshot>> snapshots;
  for (Numbers rest(numbers); !rest.is_empty();) {
    TruthSnapshot snapshot;
    snapshot.time = rest.take();
    for (std::size_t left = rest.take_count(); left > 0; --left) {
      TruthState& object = snapshot.objects.emplace_back();
      object.id = rest.take_id();
      object.position = rest.take_vector();
      object.velocity = rest.take_vector();
      object.acceleration = rest.take_vector();
    }
    for (std::size_t left = rest.take_count(); left > 0; --left) {
      BodyPose& body = snapshot.bodies.emplace_back();
      body.id = rest.take_id();
      body.position = rest.take_vector();
      body.angle = rest.take();
    }
    snapshots.push_back(std::make_shared<const TruthSnapshot>(std::move(snapshot)));
  }
  return snapshots;
}

}  // namespace ghtrack::page

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sensors/sensor.hpp"
#include "tools/run/truth_source.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack::page {

// What a page carries of a scene, and how: the truth as numbers, everything else as text that
// describe() writes here and reads there.

/// Who moved, as text.
struct RecordedObject {
  static constexpr std::array<std::pair<std::string_view, Outline::Shape>, 4> kShapes = {
      {{"box", Outline::Shape::kBox},
       {"disc", Outline::Shape::kDisc},
       {"balloon", Outline::Shape::kBalloon},
       {"drone", Outline::Shape::kDrone}}};

  std::string name, regime, label;
  std::uint64_t key = 0;
  int shape = 0;  // index into kShapes
  double length = 0.0, width = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &RecordedObject::name, {});
    v.field("regime", &RecordedObject::regime, {});
    v.field("label", &RecordedObject::label, {});
    v.field("key", &RecordedObject::key, {});
    v.field("shape", &RecordedObject::shape, {});
    v.field("length", &RecordedObject::length, {});
    v.field("width", &RecordedObject::width, {});
  }
};

/// What does not change on a page.
struct RecordedScene {
  double duration = 0.0;  // [s]
  std::uint64_t seed = 1;
  std::vector<RecordedObject> objects;  // by id

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("duration", &RecordedScene::duration, {});
    v.field("seed", &RecordedScene::seed, {});
    v.field("objects", &RecordedScene::objects, {});
  }
};

/// What may be turned on a page: the sensors, and one tracker or two, on the same detections.
struct Setting {
  std::vector<SensorConfig> sensors;
  TrackerConfig tracker;
  std::optional<TrackerConfig> other;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("sensors", &Setting::sensors, {.meaning = "what looks", .min_items = 1});
    v.field("tracker", &Setting::tracker, {.meaning = "what turns detections into tracks"});
    v.field("other", &Setting::other, {.meaning = "another tracker of the same detections"});
  }
};

std::vector<RecordedObject> to_recorded(const std::vector<ObjectInfo>& objects);
std::vector<ObjectInfo> from_recorded(const std::vector<RecordedObject>& objects);

/// A truth as a row of numbers: for each instant its time, the number of objects, of each its id,
/// position, velocity and acceleration, the number of bodies, of each its id, position and angle.
std::vector<double> to_numbers(const TruthRecording& truth);

/// The snapshots of such a row.
/// @throws std::invalid_argument if it ends within one
std::vector<std::shared_ptr<const TruthSnapshot>> from_numbers(std::span<const double> numbers);

}  // namespace ghtrack::page

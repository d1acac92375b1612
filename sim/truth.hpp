#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/plane.hpp"

namespace ghtrack {

/// Index of an object among all objects of a world, 0, 1, …; stable during a run.
using ObjectId = int;

/// What an object looks like, for pictures and for occlusion. Sizes in metres.
struct Outline {
  enum class Shape { kBox, kDisc, kBalloon, kDrone };
  Shape shape = Shape::kDisc;
  double length = 0.0;  // box: along its heading; otherwise the diameter
  double width = 0.0;   // box: across its heading
};

/// What does not change about an object during a run.
struct ObjectInfo {
  ObjectId id = 0;
  std::string name;       // unique in the scene
  std::string regime;     // the kind of motion: "train", "ball", "balloon", "drone"
  std::string label;      // the class that a perfect detector reports
  std::uint64_t key = 0;  // names the object's random streams; depends on its name alone
  Outline outline;        // of each of its rigid parts
};

/// Kinematic truth of one object, world frame.
struct TruthState {
  ObjectId id = 0;
  Vec2 position = Vec2::Zero();      // [m]
  Vec2 velocity = Vec2::Zero();      // [m/s]
  Vec2 acceleration = Vec2::Zero();  // [m/s²]
  Vec2 wind = Vec2::Zero();          // of the air where it is, if that is to be recorded [m/s]
  /// In the coupler behind it, pulling: positive, if that is to be recorded [N].
  std::optional<double> coupler_force = std::nullopt;
};

/// Pose of one rigid part, such as one car of a train, for pictures and occlusion.
struct BodyPose {
  ObjectId id = 0;
  Vec2 position = Vec2::Zero();  // [m]
  double angle = 0.0;            // [rad], counter-clockwise
  double spin = 0.0;             // [rad/s]
};

/// What may be recorded of objects beside their kinematics.
enum class TruthColumn { kHeading, kSpin, kWind, kCouplerForce };

constexpr std::array<std::pair<std::string_view, TruthColumn>, 4> enum_names(TruthColumn) {
  return {{{"heading", TruthColumn::kHeading},
           {"spin", TruthColumn::kSpin},
           {"wind", TruthColumn::kWind},
           {"coupler_force", TruthColumn::kCouplerForce}}};
}

/// What can happen to an object.
enum class EventKind {
  kContact,    // it was struck, by another object or by a surface
  kCoupling,   // it was coupled to another
  kBurst,      // it burst
  kOverrun,    // it ran past the place where it should have stopped
  kOverspeed,  // it ran faster than a speed limit allows
  kPassage,    // it passed through another, as trains do whose tracks cross
};

constexpr std::array<std::pair<std::string_view, EventKind>, 6> enum_names(EventKind) {
  return {{{"contact", EventKind::kContact},
           {"coupling", EventKind::kCoupling},
           {"burst", EventKind::kBurst},
           {"overrun", EventKind::kOverrun},
           {"overspeed", EventKind::kOverspeed},
           {"passage", EventKind::kPassage}}};
}

/// Something that has happened to an object.
struct WorldEvent {
  double time = 0.0;  // [s]
  EventKind kind = EventKind::kContact;
  ObjectId object = 0;
  ObjectId other = -1;           // −1: no object
  std::string surface = {};      // of the surroundings: "ground", "walls[2]"; empty: none
  Vec2 position = Vec2::Zero();  // of the object's centre [m]
  Vec2 impulse = Vec2::Zero();   // that it received [N s]
};

/// The state of the world at one instant. Objects that have not appeared yet are absent.
struct TruthSnapshot {
  double time = 0.0;  // [s]
  std::vector<TruthState> objects;
  std::vector<BodyPose> bodies;
};

}  // namespace ghtrack

#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace ghtrack {

/// `accelerate: 0.2`: the driver holds this acceleration as far as traction, adhesion and brakes
/// go.
struct Accelerate {
  static constexpr std::string_view kind = "accelerate";
  double acceleration = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&Accelerate::acceleration,
             {.unit = "m/s^2",
              .meaning = "held as far as traction and brakes go; negative slows down to a halt",
              .minimum = -10.0,
              .maximum = 10.0});
  }
};

/// `traction: 1`: this part of the traction that is available.
struct Traction {
  static constexpr std::string_view kind = "traction";
  double fraction = 1.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&Traction::fraction,
             {.unit = "1",
              .meaning = "part of the available traction; negative drives backwards",
              .minimum = -1.0,
              .maximum = 1.0});
  }
};

/// A tractive force whatever its speed, rising over a ramp.
struct Force {
  static constexpr std::string_view kind = "force";
  static constexpr std::string_view about = "a tractive force, whatever traction limits say";
  double force = 0.0;
  double ramp = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("force", &Force::force,
            {.unit = "N",
             .meaning = "in the end; negative: backwards",
             .required = true,
             .minimum = -1e7,
             .maximum = 1e7});
    v.field("ramp", &Force::ramp,
            {.unit = "s",
             .meaning = "time over which it rises linearly",
             .minimum = 0.0,
             .maximum = 1e4});
  }
};

/// `coast: {}`: neither traction nor brakes.
struct Coast {
  static constexpr std::string_view kind = "coast";
  static constexpr std::string_view about = "neither traction nor brakes";

  template <class Visitor>
  static void describe(Visitor&) {}
};

enum class BrakeKind { kService, kEmergency, kLocomotive };

constexpr std::array<std::pair<std::string_view, BrakeKind>, 3> enum_names(BrakeKind) {
  return {{{"service", BrakeKind::kService},
           {"emergency", BrakeKind::kEmergency},
           {"locomotive", BrakeKind::kLocomotive}}};
}

/// `brake: service`: braked to a stand, and held there.
struct Brake {
  static constexpr std::string_view kind = "brake";
  BrakeKind brake = BrakeKind::kService;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(
        &Brake::brake,
        {.meaning = "to a stand, and hold there; locomotive: with the first car's service brake "
                    "alone"});
  }
};

/// `target_speed: 40`: a driver who accelerates or brakes towards a speed and keeps it.
struct TargetSpeed {
  static constexpr std::string_view kind = "target_speed";
  double speed = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&TargetSpeed::speed, {.unit = "m/s",
                                   .meaning = "accelerate or brake to this speed and keep it",
                                   .minimum = -150.0,
                                   .maximum = 150.0});
  }
};

/// A station: the driver brakes so as to stand with the first car at a place of the track.
struct StationStop {
  static constexpr std::string_view kind = "stop_at";
  double position = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&StationStop::position,
             {.unit = "m",
              .meaning = "brake in time to stand with the first car at this place of the track",
              .minimum = -1e6,
              .maximum = 1e6});
  }
};

using DriveCommand =
    std::variant<Accelerate, Traction, Force, Coast, Brake, TargetSpeed, StationStop>;

/// What the driver does from an instant or a place on.
struct DrivePhase {
  static constexpr std::string_view about = "what the driver does from an instant or a place on";
  std::optional<double> at = std::nullopt;
  std::optional<double> at_position = std::nullopt;
  DriveCommand command = {};

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("at", &DrivePhase::at,
            {.unit = "s", .meaning = "time since the scene's start", .minimum = 0.0});
    v.field("at_position", &DrivePhase::at_position,
            {.unit = "m",
             .meaning = "of the first car on the track, instead of `at`",
             .minimum = -1e6,
             .maximum = 1e6});
    v.one_of(&DrivePhase::command, {.meaning = "what the driver does then"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (at.has_value() == at_position.has_value())
      report("at", "a phase needs either at or at_position");
  }
};

}  // namespace ghtrack

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/surface.hpp"
#include "sim/truth.hpp"
#include "sim/wind.hpp"

namespace ghtrack {

inline constexpr double kStandardGravity = 9.80665;  // [m/s²], CGPM 1901

struct Air {
  double density = 1.2;
  double viscosity = 1.81e-5;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("density", &Air::density,
            {.unit = "kg/m^3", .meaning = "0 is a vacuum", .minimum = 0.0, .maximum = 10.0});
    v.field("viscosity", &Air::viscosity,
            {.unit = "Pa s",
             .meaning = "dynamic viscosity, for Reynolds numbers",
             .above = 0.0,
             .maximum = 1.0});
  }
};

/// What surrounds the targets: the key `world:` of a scene.
struct EnvironmentConfig {
  static constexpr std::string_view about =
      "what surrounds the targets: a side view with gravity along -y, or a top view without";

  double gravity = kStandardGravity;
  Air air;
  WindConfig wind;
  std::optional<Ground> ground;
  std::vector<Wall> walls;
  std::vector<SolidBox> boxes;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("gravity", &EnvironmentConfig::gravity,
            {.unit = "m/s^2",
             .meaning = "downwards; 0 in a top view",
             .minimum = 0.0,
             .maximum = 100.0});
    v.field("air", &EnvironmentConfig::air, {.meaning = "properties of the air"});
    v.field("wind", &EnvironmentConfig::wind, {.meaning = "motion of the air"});
    v.field("ground", &EnvironmentConfig::ground, {.meaning = "what is below; left out: nothing"});
    v.field("walls", &EnvironmentConfig::walls,
            {.meaning = "walls, ramps and platforms", .max_items = 1000});
    v.field("boxes", &EnvironmentConfig::boxes, {.meaning = "blocks", .max_items = 250});
  }
};

/// The surroundings as the equations of motion see them.
class Environment {
 public:
  Environment(const EnvironmentConfig& config, std::uint64_t seed);

  const Vec2& gravity() const { return gravity_; }  // [m/s²]
  const Air& air() const { return air_; }
  const Wind& wind() const { return wind_; }
  const std::vector<Surface>& surfaces() const { return surfaces_; }

 private:
  Vec2 gravity_;
  Air air_;
  Wind wind_;
  std::vector<Surface> surfaces_;
};

}  // namespace ghtrack

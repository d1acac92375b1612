#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/surface.hpp"
#include "sim/truth.hpp"
#include "sim/wind.hpp"

namespace ghtrack {

inline constexpr double kStandardGravity = 9.80665;  // [m/s²], CGPM 1901

/// How the density of the air changes with height.
enum class Atmosphere { kUniform, kStandard };

constexpr std::array<std::pair<std::string_view, Atmosphere>, 2> enum_names(Atmosphere) {
  return {{{"uniform", Atmosphere::kUniform}, {"standard", Atmosphere::kStandard}}};
}

struct Air {
  double density = 1.2;
  double viscosity = 1.81e-5;
  Atmosphere atmosphere = Atmosphere::kUniform;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("density", &Air::density,
            {.unit = "kg/m^3",
             .meaning = "at height 0; 0 is a vacuum",
             .minimum = 0.0,
             .maximum = 10.0});
    v.field("viscosity", &Air::viscosity,
            {.unit = "Pa s",
             .meaning = "dynamic viscosity, for Reynolds numbers",
             .above = 0.0,
             .maximum = 1.0});
    v.field("atmosphere", &Air::atmosphere,
            {.meaning = "standard: thinner with height as the standard atmosphere (ISO 2533), with "
                        "`density` at height 0"});
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

  /// Density of the air at a height, a y [kg/m³].
  double air_density(double height) const {
    return air_.atmosphere == Atmosphere::kUniform ? air_.density
                                                   : air_.density * standard_thinning(height);
  }
  const Wind& wind() const { return wind_; }
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  /// Whether a place is in the ground or a box.
  bool is_solid(const Vec2& place) const;
  std::uint64_t seed() const { return seed_; }  // of the run

  /// What a surface is called: "ground", "walls[2]", "boxes[0]".
  const std::string& surface_name(int surface) const {
    return surface_names_[static_cast<std::size_t>(surface)];
  }

 private:
  static double standard_thinning(double height);

  Vec2 gravity_;
  Air air_;
  Wind wind_;
  std::optional<Ground> ground_;
  std::vector<SolidBox> boxes_;
  std::vector<Surface> surfaces_;
  std::vector<std::string> surface_names_;
  std::uint64_t seed_;
};

}  // namespace ghtrack

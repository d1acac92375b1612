#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/environment.hpp"
#include "sim/target.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

struct PhysicsConfig {
  double rate = 240.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("rate", &PhysicsConfig::rate,
            {.unit = "Hz",
             .meaning = "steps of the physics per second, whatever sensors and video do",
             .minimum = 20.0,
             .maximum = 1000.0});
  }
};

/// What is recorded of the truth beside positions, velocities and accelerations.
struct RecordConfig {
  static constexpr std::string_view about =
      "what is written of the truth beside positions, velocities and accelerations";
  bool events = false;
  std::vector<TruthColumn> columns;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field(
        "events", &RecordConfig::events,
        {.meaning = "events.csv: contacts with their impulses, couplings and contacts of buffers "
                    "with the momentum that passes until both run at one speed, bursts, stops that "
                    "were run past, speed limits that were exceeded, trains that passed through "
                    "each other"});
    v.field("columns", &RecordConfig::columns,
            {.meaning =
                 "more columns of truth.csv: heading [rad], spin [rad/s], wind_x and wind_y "
                 "at the object [m/s], coupler_force in the coupler behind a car of a train with "
                 "`couplers`, pulling positive [N]",
             .max_items = 4});
  }

  template <class Report>
  void check(Report&& report) const {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (columns[i] == columns[j]) {
          report("columns[" + std::to_string(i) + "]", "is there already");
        }
      }
    }
  }

  bool has(TruthColumn wanted) const {
    return std::find(columns.begin(), columns.end(), wanted) != columns.end();
  }
};

struct WorldConfig {
  PhysicsConfig physics;
  EnvironmentConfig environment;
  std::vector<Target> targets;
  RecordConfig record = {};
};

/// A target that would have appeared inside something and was moved out of it.
struct Displacement {
  ObjectId object = 0;
  double time = 0.0;      // [s]
  double distance = 0.0;  // [m]
};

/// All targets in their surroundings: forces in, truth out.
///
/// Each target is integrated in double precision to fourth order, bounces on ground and walls
/// included; Box2D finds who is near whom, and these move from one impact to the next, see
/// encounter/encounter.hpp. The truth of a target depends on the scene's seed, its surroundings and
/// what it touches: not on the instants at which it is sampled, nor on targets elsewhere.
class World {
 public:
  /// Blocks of copies are spelled out, nameless targets get names.
  /// @throws std::invalid_argument if the targets have problems
  World(const WorldConfig& config, std::uint64_t seed);
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  /// The objects that sensors may see, in the order of their ids.
  const std::vector<ObjectInfo>& objects() const { return objects_; }

  /// The truth at a time [s]; times must not decrease from call to call.
  /// @throws std::invalid_argument if they do
  /// @throws std::runtime_error if a target's motion has become infinite
  TruthSnapshot sample(double time);

  /// What surrounds the targets.
  const Environment& environment() const;

  /// How often so far targets passed through whatever they met during a step, because they had too
  /// many impacts within it.
  std::int64_t missed_collisions() const;

  /// The targets that have appeared inside something so far, and were moved out of it.
  const std::vector<Displacement>& displacements() const;

  /// What has happened so far, in the order of time, up to the last whole step of the physics: all
  /// of it if it is to be recorded, and in any case the stops that trains have run past and the
  /// trains that have passed through each other.
  const std::vector<WorldEvent>& events() const;

 private:
  struct Scenery;

  std::vector<ObjectInfo> objects_;
  std::unique_ptr<Scenery> scenery_;
};

}  // namespace ghtrack

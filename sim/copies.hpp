#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/truth.hpp"

namespace ghtrack {

/// `repeat: {count: 10, every: 2}`: a pitching machine, or a row of equal things.
struct Repeat {
  static constexpr std::string_view about = "the same again and again, later or farther each time";
  int count = 2;
  double every = 0.0;
  Vec2 shift = Vec2::Zero();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("count", &Repeat::count,
            {.meaning = "how many in all", .required = true, .minimum = 1, .maximum = 10'000});
    v.field("every", &Repeat::every,
            {.unit = "s",
             .meaning = "each appears so much later than the one before",
             .minimum = 0.0,
             .maximum = 1e6});
    v.field("shift", &Repeat::shift,
            {.unit = "m",
             .meaning = "each begins so far from the one before",
             .minimum = -1e5,
             .maximum = 1e5});
  }
};

/// `grid: {columns: 100, rows: 10, spacing: [5, 5]}`
struct Grid {
  static constexpr std::string_view about = "one at each point of a grid, the first at the target";
  int columns = 1;
  int rows = 1;
  Vec2 spacing = Vec2(10.0, 10.0);

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("columns", &Grid::columns,
            {.meaning = "points along x", .minimum = 1, .maximum = 10'000});
    v.field("rows", &Grid::rows, {.meaning = "points along y", .minimum = 1, .maximum = 10'000});
    v.field("spacing", &Grid::spacing,
            {.unit = "m",
             .meaning = "between neighbouring points, along x and y",
             .minimum = -1e5,
             .maximum = 1e5});
  }
};

/// `random: {count: 500, area: [200, 100]}`: scattered by the numbers of a seed of its own.
struct RandomCopies {
  static constexpr std::string_view about = "scattered around the target, uniformly at random";
  int count = 1;
  std::uint64_t seed = 1;
  Vec2 area = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double within = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("count", &RandomCopies::count,
            {.meaning = "how many", .required = true, .minimum = 1, .maximum = 10'000});
    v.field("seed", &RandomCopies::seed, {.meaning = "chooses them, whatever the scene's seed is"});
    v.field("area", &RandomCopies::area,
            {.unit = "m",
             .meaning = "width and height of the rectangle around the target in which they begin",
             .minimum = 0.0,
             .maximum = 2e5});
    v.field("velocity", &RandomCopies::velocity,
            {.unit = "m/s",
             .meaning = "their velocity differs by up to so much along x and y; of a train the "
                        "first number applies, along its track",
             .minimum = 0.0,
             .maximum = 100.0});
    v.field("within", &RandomCopies::within,
            {.unit = "s",
             .meaning = "they appear at random instants of this time, counted from the target's",
             .minimum = 0.0,
             .maximum = 1e6});
  }
};

/// `launch: {position: 0.5, velocity: 1}`: nobody throws a ball twice in the same way.
struct LaunchScatter {
  static constexpr std::string_view about = "how the starts of targets vary from run to run";
  double position = 0.0;
  double velocity = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("position", &LaunchScatter::position,
            {.unit = "m",
             .meaning = "1-sigma change of the place per axis",
             .minimum = 0.0,
             .maximum = 1e3});
    v.field("velocity", &LaunchScatter::velocity,
            {.unit = "m/s",
             .meaning = "1-sigma change of the velocity per axis, of a train along its track",
             .minimum = 0.0,
             .maximum = 100.0});
  }
};

}  // namespace ghtrack

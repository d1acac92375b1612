#pragma once

#include <string_view>

#include "sim/regimes/motion.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// A juggler's two hands. The ball flies from the first to the second and is carried to the point
/// from which it is thrown back; with several balls, one after the other, that is a cascade.
struct Juggling {
  static constexpr std::string_view about =
      "thrown to and fro for ever: caught, carried by the hand, thrown back";
  Vec2 to = Vec2::Zero();
  double flight = 0.6;
  double hold = 0.3;
  double scoop = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("to", &Juggling::to,
            {.unit = "m",
             .meaning = "the other hand; the ball's position is the first",
             .required = true,
             .minimum = -1e5,
             .maximum = 1e5});
    v.field(
        "flight", &Juggling::flight,
        {.unit = "s", .meaning = "from a throw to the catch", .minimum = 0.05, .maximum = 60.0});
    v.field(
        "hold", &Juggling::hold,
        {.unit = "s", .meaning = "from a catch to the throw", .minimum = 0.05, .maximum = 60.0});
    v.field("scoop", &Juggling::scoop,
            {.unit = "m",
             .meaning = "a hand catches so far beyond the point from which it throws, so that "
                        "crossing balls do not meet",
             .minimum = 0.0,
             .maximum = 10.0});
  }
};

/// The times and velocities of a juggled ball's throws. Phase 0 is the first flight, phase 1 the
/// hand that follows, and so on.
class JugglingPattern {
 public:
  /// @param begin  time of the first throw [s]
  JugglingPattern(const Juggling& juggling, const Vec2& from, const Vec2& gravity, double begin);

  static bool is_flight(int phase) { return phase % 2 == 0; }
  double end_of(int phase) const;

  /// Where and with what velocity the flight of this phase begins: without air it would end exactly
  /// where the other hand catches.
  PlanarMotion throw_at(int phase) const;

 private:
  Juggling juggling_;
  Vec2 from_;
  Vec2 gravity_;
  double begin_;
};

/// A hand that takes a ball from a catch to a throw: the cubic that joins both in position and
/// velocity.
struct Carry {
  double begin = 0.0;  // [s]
  double end = 1.0;    // [s]
  PlanarMotion caught;
  PlanarMotion thrown;

  PlanarMotion at(double time) const;
};

}  // namespace ghtrack

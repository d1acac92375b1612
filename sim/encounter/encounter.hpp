#pragma once

#include <vector>

#include "sim/encounter/crowd.hpp"

namespace ghtrack::encounter {

/// Two things that have met, and how.
struct Hit {
  double time = 0.0;             // [s]
  int one = 0;                   // index of the body that gives way
  int other = -1;                // of what it met, −1: a surface of the surroundings
  int surface = -1;              // which
  Vec2 position = Vec2::Zero();  // of the centre of the one [m]
  Vec2 impulse = Vec2::Zero();   // that the one received [N s]
  EventKind kind = EventKind::kContact;
};

/// What became of them.
struct Meeting {
  bool touched = false;              // otherwise everyone moved alone, as if there were no others
  bool resolved = true;              // false: too many impacts for one step
  std::vector<Mover::State> states;  // of those that give way, at the end of the step
  std::vector<Vec2> lowest;          // corners of the boxes in which their centres moved [m]
  std::vector<Vec2> highest;
  std::vector<Hit> hits;
};

/// Moves bodies that may meet each other over [from, to], from one impact to the next.
///
/// Each moves by its own equations of motion until the instant at which the distance of two falls
/// to zero, found on these very paths. There they exchange the impulse of the impact law of
/// bounce(), with e = √(e₁ e₂) and μ = √(μ₁ μ₂); where one impact makes another at the same
/// instant, as in a row of touching balls, these follow one after the other, the fastest first: a
/// Newton's cradle hands its velocity on. Bodies that are pressed together move together: the least
/// forces that keep them apart, friction included, are solved for at every stage of a common
/// Runge–Kutta step, and a step never leaves more energy than the other forces have put in.
/// @param yielding  round bodies that give way, in an order that decides ties
/// @param passing   what they may meet and what moves on regardless
Meeting meet(const std::vector<Participant>& yielding, const std::vector<Participant>& passing,
             const Environment& environment, double from, double to);

}  // namespace ghtrack::encounter

#pragma once

#include <span>
#include <vector>

#include "sim/regimes/train.hpp"

namespace ghtrack {

/// A train on a track, where others may be, too.
struct TrainOnTrack {
  const TrainModel* model = nullptr;
  TrainModel::State* state = nullptr;
  ImpactLog* log = nullptr;  // of what happens to it alone, if that is wanted
  int number = 0;            // of its target
  PlaceOnLine place = {};    // of its own line on that of the track
};

/// Two trains that have coupled.
struct TrainCoupling {
  double time = 0.0;             // [s]
  int one = 0;                   // number of the one
  int object = 0;                // its object that couples
  int other = 0;                 // number of the other
  int other_object = 0;          // and its object
  Vec2 position = Vec2::Zero();  // of the one's car that couples [m]
  /// That the one receives until all that hangs together runs at one speed [N s].
  Vec2 impulse = Vec2::Zero();
  EventKind kind = EventKind::kCoupling;  // kContact: they only buffer
};

/// Integrates the trains of one track over [from, to].
///
/// Where two touch they push each other by springs and dampers like those between their cars, in
/// series, and couple if both do. Who is inside another from the start passes through it.
/// @param couplings  gets those that have come about, if it is wanted
void advance_on_track(std::span<const TrainOnTrack> trains, double from, double to,
                      std::vector<TrainCoupling>* couplings = nullptr);

/// Whether one is inside the other, and has been since one of them appeared.
bool is_inside(const TrainOnTrack& one, const TrainOnTrack& other);

/// Trains whose lines are the same curve, as indices, and their places on that of the first.
struct Railway {
  std::vector<std::size_t> trains;  // ascending
  std::vector<PlaceOnLine> places;
};

/// The tracks that several of these trains are on.
/// @param trains  null: none
std::vector<Railway> find_railways(const std::vector<const TrainModel*>& trains);

}  // namespace ghtrack

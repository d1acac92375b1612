#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "sim/neighbours.hpp"
#include "sim/regimes/railway.hpp"

namespace ghtrack {

/// Two trains that pass through each other, and where.
struct Passage {
  std::size_t one = 0;  // index of the train
  std::size_t other = 0;
  int car = 0;  // of the one's
  int other_car = 0;
  Vec2 position = Vec2::Zero();  // of the one's car [m]
};

/// Looks for trains that pass through each other: those whose tracks cross or are one in part only,
/// and those that were inside another when they appeared. Trains side by side do not.
class PassageWatch {
 public:
  /// Pairs that do so now and have not been told of before, in the order of their numbers.
  /// @param trains  of `TrainOnTrack` numbers and states matter; those of equal `tracks` meet
  std::vector<Passage> look(std::span<const TrainOnTrack> trains, std::span<const int> tracks);

 private:
  Neighbourhood neighbourhood_;
  std::set<std::pair<int, int>> told_;
};

}  // namespace ghtrack

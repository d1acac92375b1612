#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace ghtrack {

/// A true object and a track that are near each other at one instant, as positions in their lists.
struct Pair {
  int truth = 0;
  int track = 0;
  double value = 0.0;  // a distance [m] or a similarity, as the maker says
};

/// All pairs at a distance of at most `radius`, ordered by truth, then track; value = distance.
/// The tracks are searched in rows, by x, so the cost grows with the neighbours and not with
/// |truth| × |tracks|, however they are arranged. A point that is not finite is near nothing.
std::vector<Pair> close_pairs(std::span<const Eigen::Vector2d> truth,
                              std::span<const Eigen::Vector2d> tracks, double radius);

/// An axis-parallel box, as MOTChallenge has it: y grows downwards, in pixels.
struct Box {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  Eigen::Vector2d centre() const { return {left + width / 2.0, top + height / 2.0}; }
};

/// All pairs of boxes that overlap, ordered by truth, then track; value = intersection over union.
std::vector<Pair> overlapping_pairs(std::span<const Box> truth, std::span<const Box> tracks);

}  // namespace ghtrack

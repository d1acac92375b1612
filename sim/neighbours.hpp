#pragma once

#include <cstddef>
#include <vector>

#include "sim/truth.hpp"

namespace ghtrack {

/// The box that a body sweeps during a step.
struct SweptBox {
  Vec2 low = Vec2::Zero();   // [m]
  Vec2 high = Vec2::Zero();  // [m]
  bool yields = true;        // whether the body gives way when it is hit
  int owner = 0;             // bodies of one owner do not meet
  int carrier = -1;          // nor do a body and the owner that let go of it
};

/// Bodies that may touch each other during a step, as indices into the boxes.
struct Cluster {
  std::vector<std::size_t> yielding;
  std::vector<std::size_t> unyielding;  // what these may hit; can be part of several clusters
};

/// The clusters among these boxes, by sweep and prune along x in rows of y. Bodies far from every other are in
/// none. Two bodies that are near the same unyielding one only are in different clusters, since
/// they have no influence on each other.
std::vector<Cluster> find_clusters(const std::vector<SweptBox>& boxes);

}  // namespace ghtrack

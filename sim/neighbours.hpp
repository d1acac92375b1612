#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "sim/truth.hpp"

namespace ghtrack {

/// The box that a body sweeps during a step.
struct SweptBox {
  std::size_t body = 0;      // its number, the same in every step
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

/// Finds who is near whom, with Box2D's tree of boxes: a body enters it with a margin and again
/// only when it has left that, so what moves steadily costs little, however bodies are arranged.
/// The answers depend on the boxes alone.
class Neighbourhood {
 public:
  Neighbourhood();
  ~Neighbourhood();
  Neighbourhood(Neighbourhood&&) noexcept;
  Neighbourhood& operator=(Neighbourhood&&) noexcept;

  /// Pairs of boxes that overlap and may meet, as indices, ascending.
  std::vector<std::pair<std::size_t, std::size_t>> pairs(const std::vector<SweptBox>& boxes);

  /// The clusters among these boxes. Bodies far from every other are in none. Two bodies that are
  /// near the same unyielding one only are in different clusters, since they have no influence on
  /// each other.
  std::vector<Cluster> clusters(const std::vector<SweptBox>& boxes);

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace ghtrack

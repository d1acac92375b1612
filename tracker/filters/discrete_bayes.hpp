#pragma once

#include <span>
#include <vector>

/// The histogram filter: a belief is one probability for each of a row of cells.
namespace ghtrack::discrete_bayes {

using Belief = std::vector<double>;

/// Scales the numbers to the sum 1.
/// @throws std::invalid_argument if they do not have a positive, finite sum, or one is negative
Belief normalized(std::span<const double> weights);

/// What lies beyond the row's ends.
enum class Edge {
  kWrap,      // the other end: the row is a ring
  kConstant,  // cells of a given probability; what leaves the row is lost
};

/// Moves the belief by `offset` cells and spreads it by the kernel, whose centre is its element
/// size / 2. The result is not normalised.
/// @param beyond  probability of the cells beyond the ends, for Edge::kConstant
/// @throws std::invalid_argument if belief or kernel is empty
Belief predicted(std::span<const double> belief, int offset, std::span<const double> kernel,
                 Edge edge = Edge::kWrap, double beyond = 0.0);

/// Likelihood times prior, normalised.
/// @throws std::invalid_argument if the sizes differ or every product is 0
Belief updated(std::span<const double> likelihood, std::span<const double> prior);

}  // namespace ghtrack::discrete_bayes

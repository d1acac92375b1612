#pragma once

#include <limits>
#include <span>
#include <vector>

#include "tools/metrics/close_pairs.hpp"

namespace ghtrack {

/// Chooses pairs so that no truth and no track occurs twice and
///   Σ values of the chosen pairs + limit · (number of truths that are not chosen)
/// is the least possible. Pairs with a value of `limit` or more are never chosen.
/// @param pairs  ordered by truth; values ≥ 0
/// @return indices of the chosen pairs, ascending
std::vector<std::size_t> cheapest_pairs(std::span<const Pair> pairs, int truths, int tracks,
                                        double limit);

/// Chooses pairs so that no truth and no track occurs twice and the sum of their values is the
/// greatest possible. Pairs without a positive value are never chosen.
/// @param pairs  ordered by truth
/// @return indices of the chosen pairs, ascending
std::vector<std::size_t> most_valuable_pairs(std::span<const Pair> pairs, int truths, int tracks);

/// The least possible largest value among `count` pairs in which no truth and no track occurs
/// twice; infinity if there is no such choice.
double bottleneck(std::span<const Pair> pairs, int truths, int tracks, int count);

}  // namespace ghtrack

#pragma once

#include <vector>

#include "tracker/association.hpp"

namespace ghtrack {

/// Probabilities of the pairs of a CandidateTable, each marginal over all joint assignments.
struct Marginals {
  std::vector<double> pair;    // of each candidate, in the order of the table
  std::vector<double> missed;  // of each track: that none is its own
  std::vector<double> unused;  // of each detection: that it is no track's
  double log_sum = 0.0;        // ln of the sum of the weights of all joint assignments
};

/// Marginal probabilities of a random assignment whose joint weight is the product of the weights
/// of its pairs; a track without a detection and a detection without a track weigh 1.
///
/// Loopy belief propagation of Williams & Lau, "Approximate evaluation of marginal association
/// probabilities with belief propagation", IEEE Trans. AES 50(4), 2014: with wᵢⱼ the weights,
///   μᵢⱼ = wᵢⱼ / (1 + Σ_{l≠j} wᵢₗ νₗᵢ)      from track i to detection j
///   νⱼᵢ = 1 / (1 + Σ_{k≠i} μₖⱼ)            back
/// converges always. Exact where the graph of pairs has no loops. The cost is that of the pairs,
/// times a few. `log_sum` is Bethe's approximation: of it the same holds.
/// @param weights     of each candidate, in the order of the table, ≥ 0; its cost is not used
/// @param detections  number of detections
Marginals marginals_by_belief_propagation(const CandidateTable& table,
                                          const std::vector<double>& weights, int detections);

/// The same by listing every joint assignment, for few tracks.
Marginals marginals_by_enumeration(const CandidateTable& table, const std::vector<double>& weights,
                                   int detections);

}  // namespace ghtrack

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/metrics/mot_step.hpp"

namespace ghtrack {

/// OSPA(2) (Beard, Vo & Vo 2020): OSPA between the sets of whole trajectories, where the distance
/// of two trajectories is the mean over the instants at which either exists of min(d, c), and c
/// where only one exists. It charges tracks that change their identity, which OSPA does not see.
struct Ospa2Options {
  double cutoff = 10.0;  // c [m]
  double order = 2.0;    // p, 1 ≤ p < ∞
};

/// Gathers trajectories instant by instant. Memory grows with the pairs of identities that came
/// closer than c, and with the interruptions of each identity.
class Ospa2 {
 public:
  explicit Ospa2(const Ospa2Options& options) : options_(options) {}

  /// @param step  its pairs' values are distances; pairs at c or farther need not be there
  void add(const MotStep& step);

  const Ospa2Options& options() const { return options_; }

  /// The distance over all instants so far [m].
  double result() const;

 private:
  /// A run of instants in which an identity exists, first to last.
  struct Presence {
    std::int64_t first = 0;
    std::int64_t last = 0;
  };
  using Presences = std::vector<Presence>;

  void note(std::vector<Presences>& all, std::span<const int> numbers) const;
  static std::int64_t duration(const Presences& presences);
  static std::int64_t overlap(const Presences& a, const Presences& b);

  Ospa2Options options_;
  std::int64_t instant_ = 0;
  std::vector<Presences> truth_, tracks_;  // by identity
  PairTable<double> closeness_;            // Σ (c − d) over the instants with d < c
};

}  // namespace ghtrack

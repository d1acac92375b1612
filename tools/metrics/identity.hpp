#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/metrics/mot_step.hpp"

namespace ghtrack {

/// Identity scores (Ristani et al. 2016): every object is given one track for the whole run, so
/// that they agree, at similarity ≥ 0.5, in as many scans as possible.
struct IdentityResult {
  std::int64_t true_positives = 0;   // IDTP
  std::int64_t false_positives = 0;  // IDFP
  std::int64_t false_negatives = 0;  // IDFN
  double idf1 = 0.0;
  double idp = 0.0;
  double idr = 0.0;
};

/// The result of several sequences together: counts are added.
IdentityResult combine(std::span<const IdentityResult> results);

class Identity {
 public:
  void add(const MotStep& step);
  IdentityResult result() const;

 private:
  PairTable<std::int64_t> agreement_;  // scans at similarity ≥ 0.5
  std::int64_t truth_scans_ = 0;
  std::int64_t track_scans_ = 0;
};

}  // namespace ghtrack

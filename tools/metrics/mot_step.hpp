#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "tools/metrics/close_pairs.hpp"

namespace ghtrack {

/// One instant as the identity metrics see it. Objects and tracks are numbered 0, 1, … in the order
/// of their first appearance in the run.
struct MotStep {
  std::span<const int> truth;   // the numbers of the objects that exist now
  std::span<const int> tracks;  // the numbers of the tracks that are put out now
  std::span<const Pair> pairs;  // ordered by truth; value = similarity, in (0, 1]
};

/// Similarities are compared with thresholds up to this rounding error, as TrackEval does.
inline constexpr double kSimilarityRounding = 2.220446049250313e-16;

/// A value for every pair of an object and a track that ever met.
template <class Value>
class PairTable {
 public:
  Value& at(int truth, int track) { return values_[key(truth, track)]; }

  /// Calls visit(truth, track, value) for every pair, ordered by truth, then track.
  template <class Visit>
  void each(Visit visit) const {
    std::vector<std::uint64_t> keys;
    keys.reserve(values_.size());
    for (const auto& entry : values_) keys.push_back(entry.first);
    std::sort(keys.begin(), keys.end());
    for (const std::uint64_t key : keys) {
      visit(static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffU), values_.at(key));
    }
  }

 private:
  static std::uint64_t key(int truth, int track) {
    return static_cast<std::uint64_t>(truth) << 32 | static_cast<std::uint32_t>(track);
  }

  std::unordered_map<std::uint64_t, Value> values_;
};

}  // namespace ghtrack

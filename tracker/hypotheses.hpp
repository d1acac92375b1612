#pragma once

#include <array>
#include <vector>

#include "tracker/track_state.hpp"

namespace ghtrack {

// Targets that are close for several scans cannot be told apart from one scan alone. So several
// explanations of the past are kept until later scans tell: a mixture of multi-Bernoulli densities
// beside the Poisson process of undetected targets (Williams 2015; García-Fernández, Williams,
// Granström & Svensson, "Poisson multi-Bernoulli mixture filter", IEEE Trans. AES 54(4), 2018),
// pruned and merged as a track-oriented multiple hypothesis tracker is, in clusters of targets that
// compete for the same detections (Reid 1979).

/// One way that a target may have gone: a track whose detections were such.
struct Branch {
  static constexpr std::size_t kWindow = 3;  // scans back that hypotheses are told apart by

  Track track;
  std::array<int, kWindow> recent{};  // its detections, the latest one first; 0: none
};

/// The tree of tracks of a target, or of what may be one: the ways that it may have gone.
struct TrackTree {
  int birth = 0;  // counts from 1
  int id = 0;     // 0 until it is confirmed
  std::vector<Branch> branches;
};

/// One explanation of all detections of a cluster.
struct Hypothesis {
  static constexpr int kAbsent = -1;  // it has no such target

  double log_weight = 0.0;
  std::vector<int> branch_of;  // each target's, or kAbsent
};

/// Targets that have competed for detections, and the explanations that are left, likeliest first.
/// The weights of the hypotheses sum up to 1.
struct TrackCluster {
  std::vector<TrackTree> targets;
  std::vector<Hypothesis> hypotheses;
};

}  // namespace ghtrack

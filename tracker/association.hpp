#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace ghtrack {

/// A detection that lies inside a track's gate, and what it would cost to use it there.
struct Candidate {
  int detection = 0;
  double cost = 0.0;  // ≥ 0 and below the cost of a miss
};

/// For each track the detections inside its gate, in compressed rows: the candidates of track i
/// are candidates[row_start[i]] … candidates[row_start[i + 1] - 1].
struct CandidateTable {
  std::vector<int> row_start{0};
  std::vector<Candidate> candidates;

  int rows() const { return static_cast<int>(row_start.size()) - 1; }
  std::span<const Candidate> row(int track) const {
    return {candidates.data() + row_start[track], candidates.data() + row_start[track + 1]};
  }
  void close_row() { row_start.push_back(static_cast<int>(candidates.size())); }
};

/// Detection of a track that got none.
inline constexpr int kMissed = -1;

/// Which detection each track of a scan gets, and which track each detection. Detections are
/// counted as the candidates count them.
struct Pairing {
  std::vector<int> detection_of;  // track, or kMissed
  std::vector<int> track_of;      // detection, or kMissed

  Pairing(std::size_t tracks, std::size_t detections)
      : detection_of(tracks, kMissed), track_of(detections, kMissed) {}

  void pair(std::size_t track, int detection) {
    detection_of[track] = detection;
    if (detection != kMissed) track_of[detection] = static_cast<int>(track);
  }
};

/// Gives every track at most one detection and every detection to at most one track, so that the
/// sum of the chosen costs, counting miss_cost for each track without a detection, is the least
/// possible (global nearest neighbour). @ingroup association
///
/// Sparse successive shortest augmenting paths with node potentials (Jonker & Volgenant 1987; the
/// private "miss" column of every track makes the problem always feasible). Ties are broken by
/// position in the table, so equal input gives equal output. Cost grows with the number of
/// candidates, not with tracks × detections; a track for which more than 1000 others would have to
/// be moved goes without a detection.
/// @param detections  number of detections in the scan
/// @return the detection of each track, or kMissed
std::vector<int> assign_globally(const CandidateTable& table, int detections, double miss_cost);

/// The greedy rival: takes the cheapest remaining pair again and again. @ingroup association
std::vector<int> assign_greedily(const CandidateTable& table, int detections);

}  // namespace ghtrack

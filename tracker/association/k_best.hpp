#pragma once

#include <span>
#include <vector>

#include "tracker/association.hpp"

namespace ghtrack {

/// One of several assignment problems over the same detections. A track may go without a
/// detection at no cost; the costs of pairs may be negative.
struct AssignmentProblem {
  double base = 0.0;  // cost before any pair
  CandidateTable table;
};

struct RankedAssignment {
  int problem = 0;
  double cost = 0.0;              // base and pairs
  std::vector<int> detection_of;  // of each track, or kMissed
};

/// The assignments of least cost among all of the problems, best first: Murty, "An algorithm for
/// ranking all the assignments in order of increasing cost", Operations Research 16(3), 1968, run
/// over all problems at once (Danchick & Newnam 2006). Parts of the solution space that cannot
/// hold any of them are never looked at.
/// @param detections  number of detections
/// @param most        how many are wanted
/// @param within      only those that cost at most this more than the best one
std::vector<RankedAssignment> best_assignments(std::span<const AssignmentProblem> problems,
                                               int detections, std::size_t most, double within);

}  // namespace ghtrack

#pragma once

#include <span>
#include <vector>

#include "tracker/association.hpp"
#include "tracker/track_state.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

// Two tracks may come to follow one target: it was seen twice for a while, or one of them has lost
// its own. Then they share its detections, one starving where the other is fed, and their
// predictions cannot be told apart. Two targets that pass each other are fed both.

/// Keeps count, for each confirmed track, of the scans in which it and an older rival had one
/// detection between them and expected it within the rule's distance. A scan with a detection for
/// each starts the count anew, and so does one in which they have parted.
/// @param rows     indices in `tracks` of the confirmed ones
/// @param sharing  those of them that have a rival already
/// @param table    the detections in their gates, row by row
/// @param tracks   predicted to the time of the scan, in the order of birth
void note_rivals(const MergeRule& rule, std::span<const std::size_t> rows,
                 std::span<const std::size_t> sharing, const CandidateTable& table,
                 const Pairing& pairing, std::vector<Track>& tracks);

/// Is it time to give up this track for its older rival?
inline bool is_to_merge(const MergeRule& rule, const Track& track) {
  return rule.scans > 0 && track.shared >= rule.scans;
}

}  // namespace ghtrack

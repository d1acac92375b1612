#include "tracker/merging.hpp"

#include <algorithm>
#include <utility>

namespace ghtrack {
namespace {

bool coincide(const Track& a, const Track& b, double distance) {
  const Eigen::Vector2d apart = a.prediction.position - b.prediction.position;
  const Eigen::Vector2d variance =
      a.prediction.covariance.diagonal() + b.prediction.covariance.diagonal();
  return apart.cwiseAbs2().cwiseQuotient(variance).sum() <= distance * distance;
}

/// Where a track with this id stands; tracks.size() if there is none.
std::size_t index_of(const std::vector<Track>& tracks, int id) {
  const auto found = std::find_if(tracks.begin(), tracks.end(),
                                  [id](const Track& track) { return track.id == id; });
  return static_cast<std::size_t>(found - tracks.begin());
}

/// Forgets the rival of a track when they need not share any more.
void review(const MergeRule& rule, const Pairing& pairing, std::size_t index,
            std::vector<Track>& tracks) {
  Track& track = tracks[index];
  const std::size_t rival = index_of(tracks, track.rival);
  const bool is_over =
      rival == tracks.size() ||
      (pairing.detection_of[index] != kMissed && pairing.detection_of[rival] != kMissed) ||
      !coincide(track, tracks[rival], rule.distance);
  if (is_over) track.rival = track.shared = 0;
}

}  // namespace

void note_rivals(const MergeRule& rule, std::span<const std::size_t> rows,
                 std::span<const std::size_t> sharing, const CandidateTable& table,
                 const Pairing& pairing, std::vector<Track>& tracks) {
  if (rule.scans == 0) return;
  for (const std::size_t index : sharing) review(rule, pairing, index, tracks);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (pairing.detection_of[rows[i]] != kMissed) continue;
    for (const Candidate& candidate : table.row(static_cast<int>(i))) {
      const int fed = pairing.track_of[candidate.detection];
      if (fed == kMissed || tracks[fed].status == TrackStatus::kTentative) continue;
      const Track& older = tracks[std::min(rows[i], static_cast<std::size_t>(fed))];
      Track& younger = tracks[std::max(rows[i], static_cast<std::size_t>(fed))];
      if (!coincide(older, younger, rule.distance)) continue;
      if (std::exchange(younger.rival, older.id) != older.id) younger.shared = 0;
      ++younger.shared;
      break;
    }
  }
}

}  // namespace ghtrack

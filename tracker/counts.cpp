#include <utility>

#include "tracker/association.hpp"
#include "tracker/life_cycle.hpp"
#include "tracker/merging.hpp"

namespace ghtrack {
namespace {

/// Tracks that choose among the detections at the same time: those that are confirmed, or those
/// that are not.
struct Stage {
  std::vector<std::size_t> tracks;   // row by row
  std::vector<std::size_t> sharing;  // those that have a rival
  CandidateTable table;

  explicit Stage(std::size_t expected) {
    tracks.reserve(expected);
    table.row_start.reserve(expected + 1);
    table.candidates.reserve(2 * expected);
  }

  void add(std::size_t index, const Track& track, DetectionGrid& grid, double gate) {
    tracks.push_back(index);
    if (track.shared > 0) sharing.push_back(index);
    grid.append_row(track.prediction, gate, table);
  }
};

/// The rows of a table without the detections that have a track already.
CandidateTable still_free(const CandidateTable& table, const Pairing& pairing) {
  CandidateTable rest;
  for (int row = 0; row < table.rows(); ++row) {
    for (const Candidate& candidate : table.row(row)) {
      if (pairing.track_of[candidate.detection] == kMissed) rest.candidates.push_back(candidate);
    }
    rest.close_row();
  }
  return rest;
}

/// Gives the tracks of these rows their detections.
void assign(const TrackerConfig& config, const std::vector<std::size_t>& tracks,
            const CandidateTable& table, Pairing& pairing) {
  const auto detections = static_cast<int>(pairing.track_of.size());
  const std::vector<int> assignment = config.association == Association::kNearestGreedy
                                          ? assign_greedily(table, detections)
                                          : assign_globally(table, detections, config.gate);
  for (std::size_t row = 0; row < tracks.size(); ++row) pairing.pair(tracks[row], assignment[row]);
}

/// Confirms, and says whether the track lives on.
bool survives(const TrackerConfig& config, Track& track) {
  if (track.unseen >= config.drop_unseen) return false;
  if (track.status == TrackStatus::kTentative) {
    if (config.drop_tentative_rule().holds_for(track.history)) return false;
    if (!config.confirm_rule().holds_for(track.history)) return true;
  } else if (config.drop_confirmed_rule().holds_for(track.history)) {
    return false;
  }
  track.status = track.detection ? TrackStatus::kConfirmed : TrackStatus::kCoasting;
  return !is_to_merge(config.merge, track);
}

}  // namespace

void step_by_counts(Look& look, TrackerState& state) {
  const TrackerConfig& config = look.config();
  const auto& members = look.grid.members();
  std::vector<Track>& tracks = state.tracks;
  Stage confirmed(tracks.size()), tentative(0);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    predict(tracks[i], look.elapsed);
    Stage& stage = tracks[i].status == TrackStatus::kTentative ? tentative : confirmed;
    stage.add(i, tracks[i], look.grid, config.gate);
  }
  look.clock.finished(&StepTimes::predict);

  Pairing pairing(tracks.size(), members.size());
  assign(config, confirmed.tracks, confirmed.table, pairing);
  assign(config, tentative.tracks, still_free(tentative.table, pairing), pairing);
  note_rivals(config.merge, confirmed.tracks, confirmed.sharing, confirmed.table, pairing, tracks);
  look.clock.finished(&StepTimes::associate);

  keep_if(tracks, [&](std::size_t i) {
    const int detection = pairing.detection_of[i];
    if (detection == kMissed) {
      miss(tracks[i], config, look.sensor, look.scan.time);
    } else {
      hit(tracks[i], members[detection], look.scan);
    }
    return survives(config, tracks[i]);
  });
  look.clock.finished(&StepTimes::update);

  for (std::size_t i = 0; i < members.size(); ++i) {
    if (pairing.track_of[i] != kMissed) continue;
    Track& track = tracks.emplace_back(look.begin(members[i]));
    track.id = state.next_id++;
    track.birth = track.id;
    if (config.confirm_rule().holds_for(track.history)) track.status = TrackStatus::kConfirmed;
  }
  look.clock.finished(&StepTimes::begin);
}

}  // namespace ghtrack

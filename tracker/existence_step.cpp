#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "sim/portable_math.hpp"
#include "tracker/association.hpp"
#include "tracker/association/belief_propagation.hpp"
#include "tracker/life_cycle.hpp"
#include "tracker/merging.hpp"

namespace ghtrack {
namespace {

constexpr double kLeastOddsWeighed = 1e-6;  // of a pair that is weighed
constexpr double kGreatestOdds = 1e30;      // beyond which nothing is surer

/// The tracks of a scan and the detections in their gates. The cost of a pair is −ln of its odds:
/// how much likelier the scan is with it than if the detection were nobody's and the track had
/// none.
struct Competition {
  CandidateTable table;
  std::vector<double> detection;     // of each track: probability that it had to be detected
  double log_missed = 0.0;           // ln of the probability that none is detected
  std::vector<std::size_t> sharing;  // tracks that have a rival
};

/// Who decides at once has to give a track that is not likely yet the detections that would make it
/// so: it competes as if it were at least that likely.
constexpr double kLeastClaim = 0.5;

/// @param decides  whether each track is to get one detection at once
Competition compete(Look& look, double nobodys, const std::vector<Track>& tracks, bool decides) {
  const Evidence& evidence = look.design.evidence(look.scan.sensor);
  const double least = decides ? kLeastClaim : 0.0;
  const double dearest = decides ? 0.0 : -portable::log(kLeastOddsWeighed);
  Competition result;
  result.detection.reserve(tracks.size());
  result.table.row_start.reserve(tracks.size() + 1);
  result.table.candidates.reserve(2 * tracks.size());
  const double p = evidence.detection_probability;
  std::vector<Gated> gated;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Track& track = tracks[i];
    if (track.shared > 0) result.sharing.push_back(i);
    const double r = std::max(least, *track.existence);  // that it claims
    const double due = is_due(track, look.config(), look.sensor, look.scan.time) ? p : 0.0;
    const double missed = 1.0 - r * due;
    // odds: r p N(ν; 0, S) / (nobody's · (1 − r p))
    const double base = portable::log(2.0 * std::numbers::pi * nobodys * missed / (r * p));
    look.grid.find_in_gate(reach(track), look.config().gate, gated);
    for (const Gated& near : gated) {
      const double cost = base + surprise(track, near, look.grid.members()[near.member]);
      if (cost < dearest) result.table.candidates.push_back({near.member, cost});
    }
    result.table.close_row();
    result.detection.push_back(due);
    result.log_missed += portable::log(1.0 - *track.existence * due);
  }
  return result;
}

const Candidate& candidate_of(const CandidateTable& table, std::size_t track, int detection) {
  const auto row = table.row(static_cast<int>(track));
  return *std::find_if(row.begin(), row.end(),
                       [&](const Candidate& c) { return c.detection == detection; });
}

/// Of each detection: the probability that it is no track's.
using Unused = std::vector<double>;

/// One detection for one track: those of the likeliest assignment.
Unused update_with_nearest(const Look& look, const Competition& competition, TrackerState& state) {
  const auto& [table, detection, log_missed, sharing] = competition;
  const auto& members = look.grid.members();
  const auto count = static_cast<int>(members.size());
  std::vector<Track>& tracks = state.tracks;
  const std::vector<int> assignment =
      look.config().association == Association::kNearestGreedy
          ? assign_greedily(table, count)
          : assign_globally(table, count, 0.0);  // a pair of odds below 1 is none
  Pairing pairing(tracks.size(), members.size());
  std::vector<std::size_t> rows(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    pairing.pair(i, assignment[i]);
    rows[i] = i;
  }
  note_rivals(look.config().merge, rows, sharing, table, pairing, tracks);
  look.clock.finished(&StepTimes::associate);

  Unused unused(members.size(), 1.0);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Track& track = tracks[i];
    double& r = *track.existence;
    const double p = detection[i];
    if (assignment[i] == kMissed) {
      r = after_miss(r, p);
      miss(track, look.config(), look.sensor, look.scan.time);
      continue;
    }
    const double claimed = std::max(kLeastClaim, r);
    const double log_odds = portable::log(r * (1.0 - claimed * p) / (claimed * (1.0 - r * p))) -
                            candidate_of(table, i, assignment[i]).cost;
    const double odds = std::min(kGreatestOdds, portable::exp(log_odds));
    state.log_likelihood += portable::log1p(odds);
    // It may still be nobody's, and the target missed.
    const double real = r * (1.0 - p) + (1.0 - r * p) * odds;
    r = real / (1.0 - r + real);
    hit(track, members[assignment[i]], look.scan);
    unused[assignment[i]] = 0.0;
  }
  return unused;
}

/// Tracks that follow each other's detections run together. Where two can take each other's, the
/// event in which they swap says the same of the world as the one in which they don't: its
/// probability goes to the likelier of the two, as in JPDA* (Bloem & Blom 1995).
void undo_swaps(const CandidateTable& table, int detections, std::vector<double>& pair) {
  const std::vector<int> own = assign_globally(table, detections, 0.0);
  std::vector<int> owner(static_cast<std::size_t>(detections), kMissed);
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i] != kMissed) owner[own[i]] = static_cast<int>(i);
  }
  const auto index_of = [&](int track, int detection) {
    for (int k = table.row_start[track]; k < table.row_start[track + 1]; ++k) {
      if (table.candidates[k].detection == detection) return k;
    }
    return kMissed;
  };
  for (int i = 0; i < table.rows(); ++i) {
    if (own[i] == kMissed) continue;
    const int mine = index_of(i, own[i]);
    for (int k = table.row_start[i]; k < table.row_start[i + 1]; ++k) {
      const int other = owner[table.candidates[k].detection];
      if (other == kMissed || other == i || index_of(other, own[i]) == kMissed) continue;
      pair[mine] += std::exchange(pair[k], 0.0);
    }
  }
}

/// Every detection for every track, as probable as it is.
Unused update_with_all(const Look& look, const Competition& competition, std::vector<Track>& tracks,
                       double& log_likelihood) {
  const auto& [table, detection, log_missed, sharing] = competition;
  const auto& members = look.grid.members();
  const auto count = static_cast<int>(members.size());
  std::vector<double> odds;
  odds.reserve(table.candidates.size());
  for (const Candidate& candidate : table.candidates) {
    odds.push_back(std::min(kGreatestOdds, portable::exp(-candidate.cost)));
  }
  Marginals marginals = marginals_by_belief_propagation(table, odds, count);
  log_likelihood += marginals.log_sum;
  undo_swaps(table, count, marginals.pair);
  look.clock.finished(&StepTimes::associate);

  constexpr double kNegligible = 1e-3;
  std::vector<Weighted> probable;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Track& track = tracks[i];
    double& r = *track.existence;
    const double missed = marginals.missed[i] * after_miss(r, detection[i]);
    double detected = 0.0;
    for (int k = table.row_start[i]; k < table.row_start[i + 1]; ++k) detected += marginals.pair[k];
    r = std::min(1.0, missed + detected);  // rounding may exceed it
    probable.clear();
    for (int k = table.row_start[i]; k < table.row_start[i + 1]; ++k) {
      const double probability = marginals.pair[k] / r;
      if (probability < kNegligible) continue;
      probable.push_back({&members[table.candidates[k].detection], probability});
    }
    if (!probable.empty()) pull(track, probable);
    if (probable.empty() || 2.0 * detected < r) {
      miss(track, look.config(), look.sensor, look.scan.time);
    } else {
      const auto likeliest = std::max_element(
          probable.begin(), probable.end(),
          [](const Weighted& a, const Weighted& b) { return a.probability < b.probability; });
      note_detection(track, *likeliest->detection, look.scan.time);
    }
  }
  return marginals.unused;
}

}  // namespace

void judge(const TrackerConfig& config, Track& track, int& next_id) {
  if (*track.existence < (track.id > 0 ? config.doubt() : config.existence.confirm)) {
    track.status = TrackStatus::kTentative;
    return;
  }
  if (track.id < 0) track.id = next_id++;
  track.status = track.detection ? TrackStatus::kConfirmed : TrackStatus::kCoasting;
}

std::vector<double> weigh_detections(Look& look, double nobodys, std::vector<Track>& tracks,
                                     double& log_likelihood) {
  const Competition competition = compete(look, nobodys, tracks, false);
  log_likelihood += competition.log_missed;
  return update_with_all(look, competition, tracks, log_likelihood);
}

void step_by_existence(Look& look, TrackerState& state) {
  const TrackerConfig& config = look.config();
  const Evidence& evidence = look.design.evidence(look.scan.sensor);
  const double undetected = state.undetected.before_look(evidence, look.scan.sensor, state.time);
  const double nobodys = evidence.nobodys(undetected);
  const double stay = survival(look.elapsed, evidence.lifetime);
  std::vector<Track>& tracks = state.tracks;
  for (Track& track : tracks) {
    predict(track, look.elapsed);
    *track.existence *= stay;
  }
  const bool decides = config.association != Association::kProbabilistic;
  const Competition competition = compete(look, nobodys, tracks, decides);
  state.log_likelihood =
      evidence.log_nobodys(nobodys, look.grid.members().size()) + competition.log_missed;
  look.clock.finished(&StepTimes::predict);

  const Unused unused = decides ? update_with_nearest(look, competition, state)
                                : update_with_all(look, competition, tracks, state.log_likelihood);
  keep_if(tracks, [&](std::size_t i) {
    judge(config, tracks[i], state.next_id);
    return *tracks[i].existence >= config.existence.drop && tracks[i].unseen < config.drop_unseen &&
           !is_to_merge(config.merge, tracks[i]);
  });
  look.clock.finished(&StepTimes::update);

  const double real = evidence.detection_probability * undetected / nobodys;
  for (std::size_t i = 0; i < unused.size(); ++i) {
    if (unused[i] * real < config.existence.drop) continue;
    Track& track = tracks.emplace_back(look.begin(look.grid.members()[i]));
    track.birth = state.next_birth++;
    track.id = -track.birth;
    track.existence = unused[i] * real;
    judge(config, track, state.next_id);
  }
  state.undetected.after_look(evidence, look.scan.sensor);
  look.clock.finished(&StepTimes::begin);
}

}  // namespace ghtrack

#pragma once

#include "tracker/gate.hpp"
#include "tracker/step_times.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {

/// A scan that is being processed: what all ways of doing so need.
struct Look {
  const TrackerDesign& design;
  const Scan& scan;
  const SensorTraits& sensor;
  double elapsed;  // time since the scan before [s]; infinite for the first one
  DetectionGrid grid;
  StepClock& clock;

  const TrackerConfig& config() const { return design.config(); }
  /// A new track of one of the grid's members.
  Track begin(const PlacedDetection& member) const {
    const auto index = static_cast<std::size_t>(member.detection);
    const std::string& label = scan.detections[index].label;
    return begin_track(design.filter_for(label, scan.sensor), scan, index);
  }
};

/// `life_cycle: counts`: confirmed tracks choose their detections first, by distance; hits and
/// misses among the last scans confirm and end tracks.
void step_by_counts(Look& look, TrackerState& state);

/// `life_cycle: existence`: tracks compete by likelihood ratio, weighed with their existence, and
/// the probability of existence confirms and ends them.
void step_by_existence(Look& look, TrackerState& state);

/// `association: probabilistic`, for some of the tracks, which have been predicted: each gets every
/// detection in its gate, weighed by its marginal probability.
/// @param nobodys         density of detections that are no track's [1/m²]
/// @param log_likelihood  gets what these tracks say of the scan
/// @return of each member of the grid the probability that it is none of these tracks'
std::vector<double> weigh_detections(Look& look, double nobodys, std::vector<Track>& tracks,
                                     double& log_likelihood);

/// `association: multi-scan`: as by existence, under several hypotheses of the past.
void step_by_hypotheses(Look& look, TrackerState& state);

/// Drops the tracks for which `lives` is false, in their order.
template <class Lives>
void keep_if(std::vector<Track>& tracks, Lives&& lives) {
  std::size_t alive = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!lives(i)) continue;
    if (alive != i) tracks[alive] = std::move(tracks[i]);
    ++alive;
  }
  tracks.erase(tracks.begin() + static_cast<std::ptrdiff_t>(alive), tracks.end());
}

/// Confirms a track by its existence, which gives it its id; says how it stands.
void judge(const TrackerConfig& config, Track& track, int& next_id);

}  // namespace ghtrack

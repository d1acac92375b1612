#include "tracker/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/association.hpp"

namespace ghtrack {
namespace {

void predict(Track& track, double dt) {
  predict(track.filter, dt);
  track.prediction.position = estimate(track.filter).position;
  track.prediction.covariance = innovation_covariance(track.filter, Eigen::Matrix2d::Zero());
  track.innovation_covariance = innovation_covariance(track.filter);
  track.residual.reset();
  track.detection.reset();
}

/// Which detection each of these tracks gets; the chosen ones are marked as taken.
std::vector<int> associate(const TrackerConfig& config, const std::vector<Track*>& tracks,
                           const DetectionGrid& grid, std::vector<bool>& taken) {
  CandidateTable table;
  for (const Track* track : tracks) {
    grid.append_candidates(track->prediction, config.gate, taken, table);
    table.close_row();
  }
  const auto detections = static_cast<int>(taken.size());
  std::vector<int> assignment = config.association == Association::kNearestGreedy
                                    ? assign_greedily(table, detections)
                                    : assign_globally(table, detections, config.gate);
  for (const int detection : assignment) {
    if (detection != kMissed) taken[detection] = true;
  }
  return assignment;
}

/// The same when the simulation tells which object made which detection.
std::vector<int> associate_by_identity(const std::vector<Track*>& tracks,
                                       std::span<const int> identities, std::vector<bool>& taken) {
  std::vector<int> assignment;
  for (const Track* track : tracks) {
    const auto mine = std::find(identities.begin(), identities.end(), track->identity);
    const bool seen = mine != identities.end();
    assignment.push_back(seen ? static_cast<int>(mine - identities.begin()) : kMissed);
    if (seen) taken[assignment.back()] = true;
  }
  return assignment;
}

void hit(Track& track, const Scan& scan, int detection) {
  track.detection = static_cast<std::size_t>(detection);
  const Detection& found = scan.detections[*track.detection];
  update(track.filter, found.position, found.covariance);
  track.residual = residual(track.filter);
  track.innovation_covariance = track.prediction.covariance + found.covariance;
  track.unseen = 0;
  track.history.add_hit();
}

void miss(Track& track, const SensorTraits& sensor) {
  ++track.unseen;
  if (!contains(sensor.field_of_view, track.prediction.position)) return;
  coast(track.filter);
  track.history.add_miss();
}

/// Serves some of the tracks: each gets a detection or a miss.
void serve(const TrackerConfig& config, const SensorTraits& sensor,
           const std::vector<Track*>& tracks, const Scan& scan, const DetectionGrid& grid,
           std::span<const int> identities, std::vector<bool>& taken) {
  const std::vector<int> assignment = config.association == Association::kKnown
                                          ? associate_by_identity(tracks, identities, taken)
                                          : associate(config, tracks, grid, taken);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const int detection = assignment[i];
    if (detection == kMissed) {
      miss(*tracks[i], sensor);
    } else {
      hit(*tracks[i], scan, detection);
    }
  }
}

/// Confirms, and says whether the track lives on.
bool survives(const TrackerConfig& config, Track& track) {
  if (track.unseen >= config.drop_unseen) return false;
  if (track.status == TrackStatus::kTentative) {
    if (config.drop_tentative.holds_for(track.history)) return false;
    if (!config.confirm.holds_for(track.history)) return true;
  } else if (config.drop_confirmed.holds_for(track.history)) {
    return false;
  }
  track.status = track.detection ? TrackStatus::kConfirmed : TrackStatus::kCoasting;
  return true;
}

Track begin_track(const TrackerDesign& design, int id, const Scan& scan, std::size_t index) {
  const Detection& detection = scan.detections[index];
  Track track{.id = id,
              .filter = design.filter_for(detection.label, scan.sensor),
              .label = detection.label,
              .history = {},
              .prediction = {detection.position, detection.covariance},
              .innovation_covariance = 2.0 * detection.covariance,
              .residual = {},
              .detection = index};
  start(track.filter, detection.position, detection.covariance);
  if (design.config().confirm.holds_for(track.history)) track.status = TrackStatus::kConfirmed;
  return track;
}

/// The tracks of one stage: confirmed and coasting ones, or tentative ones.
std::vector<Track*> select(std::vector<Track>& tracks, bool tentative) {
  std::vector<Track*> selected;
  for (Track& track : tracks) {
    if ((track.status == TrackStatus::kTentative) == tentative) selected.push_back(&track);
  }
  return selected;
}

void add_lag(TrackEstimate& estimate, const Filter& filter) {
  if (!std::holds_alternative<GainFilter<2>>(filter)) return;
  const double lag = steady_lag(filter, 1.0).x;
  if (estimate.gains.order == 1) estimate.lag_per_acceleration = lag;
  if (estimate.gains.order == 2) estimate.lag_per_jerk = lag;
}

}  // namespace

TrackerDesign::TrackerDesign(TrackerConfig config, std::vector<SensorTraits> sensors)
    : config_(std::move(config)), sensors_(std::move(sensors)) {
  for (const SensorTraits& sensor : sensors_) {
    FiltersByLabel& filters = filters_.emplace_back();
    filters.emplace(TrackerConfig::kDefaultFilter, make_filter({}, sensor.sigma, sensor.period));
    for (const auto& [label, filter] : config_.filters) {
      filters.insert_or_assign(label, make_filter(filter, sensor.sigma, sensor.period));
    }
  }
}

const Filter& TrackerDesign::filter_for(const std::string& label, int sensor) const {
  const FiltersByLabel& filters = filters_.at(static_cast<std::size_t>(sensor));
  const auto found = filters.find(label);
  return found != filters.end() ? found->second
                                : filters.at(std::string(TrackerConfig::kDefaultFilter));
}

TrackerState step(const TrackerDesign& design, TrackerState state, const Scan& scan,
                  std::span<const int> identities) {
  const TrackerConfig& config = design.config();
  const SensorTraits& sensor = design.sensor(scan.sensor);
  if (!(scan.time >= state.time) || !std::isfinite(scan.time)) {
    ++state.scans_refused;
    return state;
  }
  for (Track& track : state.tracks) predict(track, scan.time - state.time);
  state.time = scan.time;
  state.sensor = scan.sensor;

  std::vector<bool> taken(scan.detections.size(), false);
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (is_usable(scan.detections[i])) continue;
    taken[i] = true;
    ++state.detections_refused;
  }
  const DetectionGrid grid(scan.detections);
  for (const bool tentative : {false, true}) {
    serve(config, sensor, select(state.tracks, tentative), scan, grid, identities, taken);
  }
  std::erase_if(state.tracks, [&](Track& track) { return !survives(config, track); });

  for (std::size_t i = 0; i < taken.size(); ++i) {
    const bool known = config.association == Association::kKnown;
    if (taken[i] || (known && identities[i] == Track::kUnknown)) continue;
    state.tracks.push_back(begin_track(design, state.next_id++, scan, i));
    if (known) state.tracks.back().identity = identities[i];
  }
  return state;
}

TrackSnapshot snapshot(const TrackerState& state) {
  TrackSnapshot result{.time = state.time, .sensor = state.sensor, .tracks = {}};
  result.tracks.reserve(state.tracks.size());
  for (const Track& track : state.tracks) {
    const Kinematics<2>& now = estimate(track.filter);
    result.tracks.push_back({.id = track.id,
                             .status = track.status,
                             .filter = std::string(name(track.filter)),
                             .label = track.label,
                             .position = now.position,
                             .velocity = now.velocity,
                             .acceleration = now.acceleration,
                             .prior_position = track.prediction.position,
                             .residual = track.residual,
                             .detection = track.detection,
                             .sigma = position_sigma(track.filter),
                             .innovation_covariance = track.innovation_covariance,
                             .gains = steady_gains(track.filter),
                             .noise_sigma = noise_sigma(track.filter)});
    add_lag(result.tracks.back(), track.filter);
  }
  return result;
}

}  // namespace ghtrack

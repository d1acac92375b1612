#include "tracker/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "tracker/association.hpp"
#include "tracker/merging.hpp"

namespace ghtrack {
namespace {

void predict(Track& track, double dt) {
  std::visit(
      [&](auto& filter) {
        filter.predict(dt);
        track.prediction.position = filter.estimate().position;
        track.prediction.covariance = filter.innovation_covariance(Eigen::Matrix2d::Zero());
        const double nominal_variance = filter.sigma() * filter.sigma();
        track.innovation_covariance =
            track.prediction.covariance + nominal_variance * Eigen::Matrix2d::Identity();
      },
      track.filter);
  track.residual.reset();
  track.detection.reset();
}

void hit(Track& track, const DetectionGrid::Member& found, const Scan& scan) {
  track.detection = static_cast<std::size_t>(found.detection);
  const bool is_used = update(track.filter, scan.detections[*track.detection]);
  if (is_used) track.residual = found.position - track.prediction.position;
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

/// Tracks that choose among the detections at the same time: those that are confirmed, or those
/// that are not.
struct Stage {
  std::vector<std::size_t> tracks;  // row by row
  CandidateTable table;

  explicit Stage(std::size_t expected) {
    tracks.reserve(expected);
    table.row_start.reserve(expected + 1);
    table.candidates.reserve(2 * expected);
  }

  void add(std::size_t index, const Track& track, const DetectionGrid& grid, double gate) {
    tracks.push_back(index);
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
    if (config.drop_tentative.holds_for(track.history)) return false;
    if (!config.confirm.holds_for(track.history)) return true;
  } else if (config.drop_confirmed.holds_for(track.history)) {
    return false;
  }
  track.status = track.detection ? TrackStatus::kConfirmed : TrackStatus::kCoasting;
  return !is_to_merge(config.merge, track);
}

Track begin_track(const TrackerDesign& design, int id, const Scan& scan, std::size_t index) {
  const Detection& detection = scan.detections[index];
  Track track{.id = id,
              .history = {},
              .detection = index,
              .filter = design.filter_for(detection.label, scan.sensor),
              .label = detection.label,
              .prediction = {detection.position, detection.covariance},
              .innovation_covariance = 2.0 * detection.covariance,
              .residual = {}};
  start(track.filter, detection.position, detection.covariance);
  if (design.config().confirm.holds_for(track.history)) track.status = TrackStatus::kConfirmed;
  return track;
}

std::optional<DesignedStep> designed_step(const Filter& filter) {
  const GainFilter<2>* const designed = designed_gain_filter(filter);
  if (designed == nullptr) return std::nullopt;
  return DesignedStep{.gains = designed->used_gains(),
                      .interval = designed->used_interval(),
                      .noise_velocity = designed->noise_velocity_sigma()};
}

/// The filter of detections that nobody has classified.
FilterConfig default_filter(const std::map<std::string, FilterConfig>& filters) {
  if (filters.empty()) return {};
  if (filters.size() == 1) return filters.begin()->second;
  MultipleModelConfig all;
  for (const auto& [label, config] : filters) {
    std::visit(
        [&all, &label = label](const auto& filter) {
          if constexpr (requires { filter.filters; }) {
            for (const auto& [model, single] : filter.filters) {
              all.filters.emplace(label + " " + model, single);
            }
          } else {
            all.filters.emplace(label, filter);
          }
        },
        config);
  }
  return all;
}

}  // namespace

TrackerDesign::TrackerDesign(TrackerConfig config, std::vector<SensorTraits> sensors)
    : config_(std::move(config)), sensors_(std::move(sensors)) {
  if (config_.association == Association::kKnown) {
    throw std::invalid_argument("a tracker cannot know which object a detection is of");
  }
  std::map<std::string, FilterConfig> by_label = config_.filters;
  by_label.try_emplace(std::string(TrackerConfig::kDefaultFilter), default_filter(config_.filters));
  // Gains that somebody has set are meant for the sensor that tells most in a given time.
  const auto best = std::min_element(
      sensors_.begin(), sensors_.end(), [](const SensorTraits& a, const SensorTraits& b) {
        return a.sigma * a.sigma * a.period < b.sigma * b.sigma * b.period;
      });
  for (std::size_t sensor = 0; sensor < sensors_.size(); ++sensor) {
    FiltersByLabel& filters = filters_.emplace_back();
    for (const auto& [label, filter] : by_label) {
      filters.emplace(label, make_filter(filter, best->sigma, best->period));
    }
  }
}

const Filter& TrackerDesign::filter_for(std::string_view label, int sensor) const {
  const FiltersByLabel& filters = filters_.at(static_cast<std::size_t>(sensor));
  const auto found = filters.find(label);
  return found != filters.end() ? found->second
                                : filters.find(TrackerConfig::kDefaultFilter)->second;
}

TrackerState step(const TrackerDesign& design, TrackerState state, const Scan& scan,
                  StepTimes* times) {
  StepClock clock(times);
  const TrackerConfig& config = design.config();
  const SensorTraits& sensor = design.sensor(scan.sensor);
  if (!(scan.time >= state.time) || !std::isfinite(scan.time)) {
    ++state.scans_refused;
    state.fate = ScanFate::kRefused;
    return state;
  }
  state.fate = ScanFate::kProcessed;
  const double dt = scan.time - state.time;
  state.time = scan.time;
  state.sensor = scan.sensor;
  std::vector<Track>& tracks = state.tracks;

  const DetectionGrid grid(scan.detections);
  const auto& members = grid.members();
  state.detections_refused += static_cast<std::int64_t>(scan.detections.size() - members.size());
  Stage confirmed(tracks.size()), tentative(0);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    predict(tracks[i], dt);
    Stage& stage = tracks[i].status == TrackStatus::kTentative ? tentative : confirmed;
    stage.add(i, tracks[i], grid, config.gate);
  }

  clock.finished(&StepTimes::predict);

  Pairing pairing(tracks.size(), members.size());
  assign(config, confirmed.tracks, confirmed.table, pairing);
  assign(config, tentative.tracks, still_free(tentative.table, pairing), pairing);
  note_rivals(config.merge, confirmed.tracks, confirmed.table, pairing, tracks);
  clock.finished(&StepTimes::associate);

  std::size_t alive = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const int detection = pairing.detection_of[i];
    if (detection == kMissed) {
      miss(tracks[i], sensor);
    } else {
      hit(tracks[i], members[detection], scan);
    }
    if (!survives(config, tracks[i])) continue;
    if (alive != i) tracks[alive] = std::move(tracks[i]);
    ++alive;
  }
  tracks.erase(tracks.begin() + static_cast<std::ptrdiff_t>(alive), tracks.end());
  clock.finished(&StepTimes::update);

  for (std::size_t i = 0; i < members.size(); ++i) {
    if (pairing.track_of[i] != kMissed) continue;
    const auto index = static_cast<std::size_t>(members[i].detection);
    tracks.push_back(begin_track(design, state.next_id++, scan, index));
  }
  clock.finished(&StepTimes::begin);
  return state;
}

TrackSnapshot snapshot(const TrackerState& state) {
  TrackSnapshot result{.time = state.time, .sensor = state.sensor, .tracks = {}};
  result.tracks.reserve(state.tracks.size());
  for (const Track& track : state.tracks) {
    const Kinematics<2>& now = estimate(track.filter);
    result.tracks.push_back(
        {.id = track.id,
         .status = track.status,
         .filter = std::string(name(track.filter)),
         .model = std::string(model_name(track.filter)),
         .label = track.label,
         .position = now.position,
         .velocity = now.velocity,
         .acceleration = now.acceleration,
         .prior_position = track.prediction.position,
         .residual = track.residual,
         .detection = track.detection,
         .sigma = position_sigma(track.filter),
         .covariance = innovation_covariance(track.filter, Eigen::Matrix2d::Zero()),
         .innovation_covariance = track.innovation_covariance,
         .gains = steady_gains(track.filter),
         .noise_sigma = noise_sigma(track.filter),
         .designed = designed_step(track.filter)});
  }
  return result;
}

}  // namespace ghtrack

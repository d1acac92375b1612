#include "tracker/boxes/box_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/association.hpp"

namespace ghtrack {
namespace {

bool is_usable(const BoxDetection& detection) {
  const BoundingBox& box = detection.box;
  return box.centre.allFinite() && box.size.allFinite() && box.size.minCoeff() > 0.0 &&
         std::isfinite(box.area()) && box.area() > 0.0;
}

void predict(const BoxTrackerConfig& config, BoxTrack& track, double dt) {
  track.box.centre += dt * track.velocity;
  track.motion = extrapolated(track.motion, dt);
  track.motion +=
      process_noise(ProcessModel::kWhiteNoise, 1, config.acceleration * config.acceleration, dt);
  track.size_variance += config.size_drift * config.size_drift * dt;
  track.detection.reset();
}

void hit(const BoxTrackerConfig& config, BoxTrack& track, const BoundingBox& seen,
         std::size_t index) {
  const double noise = config.position_noise * config.position_noise;
  const double total = track.motion.xx + noise;
  const AxisGain<double> gain{track.motion.xx / total, track.motion.xv / total, 0.0};
  const Eigen::Vector2d residual = seen.centre - track.box.centre;
  track.box.centre += gain.x * residual;
  track.velocity += gain.v * residual;
  track.motion = corrected(track.motion, gain, noise);

  const double size_noise = config.size_noise * config.size_noise;
  const double size_gain = track.size_variance / (track.size_variance + size_noise);
  track.box.size += size_gain * (seen.size - track.box.size);
  track.size_variance *= 1.0 - size_gain;

  track.detection = index;
  track.unseen = 0;
  track.history.add_hit();
}

void miss(BoxTrack& track, int images) {
  track.unseen += images;
  track.history.add_miss();
}

BoxTrack begin_track(const BoxTrackerConfig& config, int id, const BoundingBox& box,
                     std::size_t index) {
  BoxTrack track{.id = id, .history = {}, .detection = index, .box = box};
  track.motion.xx = config.position_noise * config.position_noise;
  track.motion.vv = config.initial_speed * config.initial_speed;
  track.size_variance = config.size_noise * config.size_noise;
  if (config.confirm.holds_for(track.history)) track.status = TrackStatus::kConfirmed;
  return track;
}

bool survives(const BoxTrackerConfig& config, BoxTrack& track) {
  if (track.unseen >= config.drop_unseen) return false;
  if (!track.box.centre.allFinite() || !std::isfinite(track.motion.xx)) return false;
  if (track.status == TrackStatus::kTentative) {
    if (config.drop_tentative.holds_for(track.history)) return false;
    if (!config.confirm.holds_for(track.history)) return true;
  }
  track.status = track.detection ? TrackStatus::kConfirmed : TrackStatus::kCoasting;
  return true;
}

/// Who takes part in one round of the association.
struct Round {
  bool tentative;  // tracks that are not confirmed, or those that are
  bool confident;  // boxes that may start a track, or the others
};

}  // namespace

double box_distance(const BoxTrackerConfig& config, const BoxTrack& track, const BoundingBox& box) {
  const double noise = config.position_noise * config.position_noise;
  const double size_noise = config.size_noise * config.size_noise;
  const double place = (box.centre - track.box.centre).squaredNorm() /
                       (track.box.area() * (track.motion.xx + noise));
  const double size = (box.size - track.box.size).cwiseQuotient(track.box.size).squaredNorm() /
                      (track.size_variance + size_noise);
  return std::sqrt(place + size);
}

BoxTrackerState step(const BoxTrackerConfig& config, BoxTrackerState state, const BoxScan& scan) {
  if (!(scan.time > state.time) || !std::isfinite(scan.time)) {
    ++state.scans_refused;
    return state;
  }
  const double dt = scan.time - state.time;
  state.time = scan.time;
  std::vector<BoxTrack>& tracks = state.tracks;
  for (BoxTrack& track : tracks) predict(config, track, dt);

  const auto is_confident = [&](const BoxDetection& detection) {
    return !config.start_confidence || detection.confidence >= *config.start_confidence;
  };
  std::vector<int> usable;
  for (std::size_t i = 0; i < scan.detections.size(); ++i) {
    if (is_usable(scan.detections[i])) usable.push_back(static_cast<int>(i));
  }
  state.detections_refused += static_cast<std::int64_t>(scan.detections.size() - usable.size());

  Pairing pairing(tracks.size(), scan.detections.size());
  const auto associate = [&](const Round& round) {
    std::vector<std::size_t> rows;
    CandidateTable table;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const bool is_tentative = tracks[i].status == TrackStatus::kTentative;
      if (is_tentative != round.tentative || pairing.detection_of[i] != kMissed) continue;
      rows.push_back(i);
      for (const int j : usable) {
        const BoxDetection& detection = scan.detections[j];
        if (pairing.track_of[j] != kMissed || is_confident(detection) != round.confident) continue;
        const double distance = box_distance(config, tracks[i], detection.box);
        if (distance <= config.gate) table.candidates.push_back({j, distance});
      }
      table.close_row();
    }
    const auto assignment =
        assign_globally(table, static_cast<int>(scan.detections.size()), config.gate);
    for (std::size_t row = 0; row < rows.size(); ++row) pairing.pair(rows[row], assignment[row]);
  };
  associate({.tentative = false, .confident = true});
  if (config.start_confidence) associate({.tentative = false, .confident = false});
  associate({.tentative = true, .confident = true});

  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const int detection = pairing.detection_of[i];
    if (detection == kMissed) {
      miss(tracks[i], static_cast<int>(std::min(dt, 1e6)));
    } else {
      hit(config, tracks[i], scan.detections[detection].box, static_cast<std::size_t>(detection));
    }
  }
  std::erase_if(tracks, [&](BoxTrack& track) { return !survives(config, track); });

  for (const int i : usable) {
    const BoxDetection& detection = scan.detections[i];
    if (pairing.track_of[i] != kMissed || !is_confident(detection)) continue;
    tracks.push_back(
        begin_track(config, state.next_id++, detection.box, static_cast<std::size_t>(i)));
  }
  return state;
}

}  // namespace ghtrack

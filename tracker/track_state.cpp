#include "tracker/track_state.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

/// Partial scans come round to a place once in a period, give or take half of it.
bool is_look(const Track& track, const SensorTraits& sensor, double time) {
  return sensor.coverage == Coverage::kWhole ||
         time - track.seen_at >= (track.unseen + 1.5) * sensor.period;
}

/// Whether it is expected below the floor, and no error of its place explains that.
bool is_below(const Track& track, const TrackerConfig& config) {
  if (!config.floor) return false;
  const auto& [position, covariance] = track.prediction;
  return position.y() + config.gate * std::sqrt(covariance(1, 1)) < *config.floor;
}

/// Whether the prediction is a mixture, which no single covariance describes.
bool is_mixed(const Track& track) { return std::holds_alternative<ImmFilter<2>>(track.filter); }

/// Of the position's error, about the estimate, if the mode that knows it least were the right one.
Eigen::Matrix2d widest_covariance(const ImmFilter<2>& mixed) {
  Eigen::Matrix2d widest = mixed.innovation_covariance(Eigen::Matrix2d::Zero());
  for (const ImmFilter<2>::Mode& mode : mixed.modes()) {
    const Eigen::Vector2d d = mode.filter.estimate().position - mixed.estimate().position;
    const Eigen::Matrix2d own =
        mode.filter.innovation_covariance(Eigen::Matrix2d::Zero()) + d * d.transpose();
    if (own.trace() > widest.trace()) widest = own;
  }
  return widest;
}

}  // namespace

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

Prediction reach(const Track& track) {
  const auto* const mixed = std::get_if<ImmFilter<2>>(&track.filter);
  if (mixed == nullptr) return track.prediction;
  return {track.prediction.position, widest_covariance(*mixed)};
}

Track begin_track(const Filter& filter, const Scan& scan, std::size_t index) {
  const Detection& detection = scan.detections[index];
  Track track{.existence = {},
              .seen_at = scan.time,
              .history = {},
              .detection = index,
              .filter = filter,
              .label = detection.label,
              .prediction = {detection.position, detection.covariance},
              .innovation_covariance = 2.0 * detection.covariance,
              .residual = {}};
  start(track.filter, detection.position, detection.covariance);
  return track;
}

double surprise(const Track& track, const Gated& gated, const PlacedDetection& detection) {
  if (!is_mixed(track)) return 0.5 * (gated.squared_distance + portable::log(gated.determinant));
  const double log_density =
      log_likelihood(track.filter, detection.position, detection.covariance).value_or(-700.0);
  return -log_density - portable::log(2.0 * std::numbers::pi);
}

void hit(Track& track, const PlacedDetection& found, const Scan& scan) {
  const Detection& detection = scan.detections[static_cast<std::size_t>(found.detection)];
  const bool is_used = update(track.filter, found.position, found.covariance, detection.measured);
  note_detection(track, found, scan.time);
  if (!is_used) track.residual.reset();
}

void note_detection(Track& track, const PlacedDetection& found, double time) {
  track.detection = static_cast<std::size_t>(found.detection);
  track.residual = found.position - track.prediction.position;
  track.innovation_covariance = track.prediction.covariance + found.covariance;
  track.unseen = 0;
  track.seen_at = time;
  track.history.add_hit();
}

// A Kalman filter takes the mixture's moments from one measurement: with β the probability that a
// detection is the track's own, ν the weighted innovation Σ βⱼ νⱼ and M = Σ βⱼ νⱼ νⱼᵀ − ν νᵀ its
// spread, the gain K = P Hᵀ S⁻¹ has to correct by K ν, and the covariance to lose
// K (β S − M) Kᵀ. That is what a measurement does whose innovation has the covariance
// S' = S (β S − M)⁻¹ S and is S' S⁻¹ ν. Where the spread outweighs the information, none is left.
// Given gains do not ask for the covariance: they get ν itself.
void pull(Track& track, std::span<const Weighted> probable) {
  constexpr double kLeastInformation = 0.05;  // of β S
  const Eigen::Vector2d& expected = track.prediction.position;
  double total = 0.0;
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();
  for (const auto& [detection, probability] : probable) {
    const Eigen::Vector2d residual = detection->position - expected;
    total += probability;
    innovation += probability * residual;
    spread += probability * residual * residual.transpose();
    noise += probability * detection->covariance;
  }
  spread -= innovation * innovation.transpose();
  const Eigen::Matrix2d s = track.prediction.covariance + noise / total;
  const Eigen::Matrix2d inverse = s.inverse();

  const GainFilter<2>* const designed = designed_gain_filter(track.filter);
  Eigen::Vector2d shift = innovation;
  Eigen::Matrix2d covariance = s / total;
  if (designed == nullptr) {
    // M is scaled down until β S − M keeps some information on every axis.
    const double share = (inverse * spread).trace() / total;
    const double keep = std::min(1.0, (1.0 - kLeastInformation) / std::max(share, 1e-300));
    covariance = s * (total * s - keep * spread).inverse() * s;
    shift = covariance * inverse * innovation;
  }
  update(track.filter, expected + shift, covariance - track.prediction.covariance);
}

bool is_due(const Track& track, const TrackerConfig& config, const SensorTraits& sensor,
            double time) {
  return is_look(track, sensor, time) &&
         (contains(sensor.field_of_view, track.prediction.position) || is_below(track, config));
}

void miss(Track& track, const TrackerConfig& config, const SensorTraits& sensor, double time) {
  const bool due = is_due(track, config, sensor, time);
  if (is_look(track, sensor, time)) ++track.unseen;
  if (!due) return;
  coast(track.filter);
  track.history.add_miss();
}

}  // namespace ghtrack

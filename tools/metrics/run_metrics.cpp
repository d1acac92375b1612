#include "tools/metrics/run_metrics.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

bool counts_as_output(const TrackEstimate& track) {
  return track.status != TrackStatus::kTentative;
}

std::optional<double> root_mean(double sum, std::int64_t count) {
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

std::optional<double> mean(double sum, std::int64_t count) {
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace

RunMetricsOptions scoring_for(const std::vector<SensorTraits>& sensors) {
  RunMetricsOptions scoring;
  scoring.sigma = 0.0;
  scoring.period = std::numeric_limits<double>::infinity();
  for (const SensorTraits& sensor : sensors) {
    scoring.sigma = std::max(scoring.sigma, sensor.sigma);
    scoring.period = std::min(scoring.period, sensor.period);
  }
  return scoring;
}

RunMetrics::RunMetrics(std::vector<ObjectInfo> objects, const RunMetricsOptions& options,
                       std::size_t contender)
    : objects_(std::move(objects)),
      options_(options),
      contender_(contender),
      tallies_(objects_.size()),
      following_(objects_.size()),
      latest_errors_(objects_.size()),
      mot_({options.gospa().cutoff, options.gospa().order}) {
  if (options.with_floor) floor_.emplace(objects_.size(), options.sigma, options.period);
}

void RunMetrics::add_observation(const TruthSnapshot& truth, const Observation& observation) {
  if (floor_) floor_->add_observation(truth, observation);
  const std::vector<const TruthState*> state_of = states_by_id(truth, objects_.size());
  for (std::size_t i = 0; i < observation.origins.size(); ++i) {
    if (observation.origins[i] == kClutterOrigin) continue;
    const auto object = static_cast<std::size_t>(observation.origins[i]);
    if (state_of.at(object) == nullptr) continue;
    ObjectTally& tally = tallies_[object];
    ++tally.detections;
    tally.squared_measurement_error +=
        (observation.scan.detections[i].position - state_of[object]->position).squaredNorm();
  }
}

void RunMetrics::add_tracks(const StepRecord& record) {
  if (record.contender != contender_ || !record.is_in_order()) return;
  if (floor_) floor_->go_to(record.tracks.time, record.tracks.sensor);
  score_sets(record);
  following_.update(record);

  const std::vector<std::optional<std::size_t>> chosen = choose_tracks(record);
  latest_errors_.assign(objects_.size(), std::nullopt);
  for (const TruthState& truth : record.truth.objects) {
    const auto object = static_cast<std::size_t>(truth.id);
    ObjectTally& tally = tallies_.at(object);
    if (tally.scans == 0) tally.first_time = record.truth.time;
    ++tally.scans;
    if (chosen[object]) {
      const TrackEstimate& track = record.tracks.tracks[*chosen[object]];
      score_object(truth, track, record.truth.time);
      if (used_object(track, record.observation) == truth.id) {
        ++tally.detections_used;
      }
    } else {
      if (tally.followed) ++tally.track_losses;
      if (tally.calm_scans < kCalmScans) tally.calm_scans = 0;
    }
    tally.followed = chosen[object].has_value();
  }
}

void RunMetrics::score_sets(const StepRecord& record) {
  std::vector<std::int64_t> truth_ids, track_ids;
  std::vector<Vec2> truth, tracks;
  for (const TruthState& object : record.truth.objects) {
    truth_ids.push_back(object.id);
    truth.push_back(object.position);
  }
  for (const TrackEstimate& track : record.tracks.tracks) {
    if (!counts_as_output(track)) continue;
    track_ids.push_back(track.id);
    tracks.push_back(track.position);
  }
  if (truth.empty() && tracks.empty()) return;

  ++sums_.scans;
  const GospaResult sets = gospa(truth, tracks, options_.gospa());
  sums_.gospa += sets.gospa;
  sums_.gospa_localisation += sets.localisation;
  sums_.gospa_missed += sets.missed;
  sums_.gospa_false += sets.false_tracks;
  sums_.ospa += sets.ospa;
  sums_.switches += switches_.add(truth_ids, track_ids, sets.matches);
  sums_.missed_targets += sets.missed_count;
  sums_.false_tracks += sets.false_count;
  mot_.add_points(truth_ids, truth, track_ids, tracks, options_.matching());
}

/// For each object the index of the track that follows it: rather one that used its detection in
/// this scan, then the one that followed it before, then the oldest.
std::vector<std::optional<std::size_t>> RunMetrics::choose_tracks(const StepRecord& record) {
  const std::vector<TrackEstimate>& tracks = record.tracks.tracks;
  std::vector<std::optional<std::size_t>> chosen(objects_.size());
  const auto rank = [&](std::size_t i, ObjectId object) {
    const ObjectTally& tally = tallies_[static_cast<std::size_t>(object)];
    return std::tuple(used_object(tracks[i], record.observation) != object,
                      tally.track != tracks[i].id, tracks[i].id);
  };
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const std::optional<ObjectId> object = following_.object_of(tracks[i].id);
    if (!object || !counts_as_output(tracks[i])) continue;
    auto& best = chosen.at(static_cast<std::size_t>(*object));
    if (!best || rank(i, *object) < rank(*best, *object)) best = i;
  }
  return chosen;
}

void RunMetrics::score_object(const TruthState& truth, const TrackEstimate& track, double time) {
  ObjectTally& tally = tallies_[static_cast<std::size_t>(truth.id)];
  if (tally.track && tally.track != track.id) {
    ++tally.track_changes;
    if (tally.followed) ++tally.track_losses;
  }
  tally.track = track.id;

  const Vec2 error = track.position - truth.position;
  latest_errors_[static_cast<std::size_t>(truth.id)] = error;
  tally.peak_error = std::max(tally.peak_error, error.norm());
  watch_settling(tally, error.norm(), time);
  tally.squared_error.add(error.squaredNorm());
  tally.error += error;
  tally.squared_velocity_error += (track.velocity - truth.velocity).squaredNorm();

  tally.predicted_square += track.noise_sigma.squaredNorm();
  if (const double speed = truth.velocity.norm(); speed > 0.0) {
    tally.lag -= error.dot(truth.velocity) / speed;
  }
  if (track.designed) add_expected_lag(tally, truth, track);
  if (const auto squares = floor_ ? floor_->squared_errors(truth.id) : std::nullopt) {
    for (std::size_t i = 0; i < squares->size(); ++i) tally.floor_square[i] += (*squares)[i];
    ++tally.floor_count;
  }
  if (track.covariance.determinant() > 0.0) {
    tally.nees.add(error.dot(track.covariance.inverse() * error));
  }
  if (track.residual) {
    const Vec2& residual = *track.residual;
    tally.innovation += residual.norm();
    ++tally.innovations;
    if (track.innovation_covariance.determinant() > 0.0) {
      tally.nis += residual.dot(track.innovation_covariance.inverse() * residual);
      ++tally.nis_count;
    }
  }

  const auto usage = std::find_if(tally.usage.begin(), tally.usage.end(), [&](const Usage& u) {
    return u.filter == track.filter && u.gains == track.gains;
  });
  if (usage == tally.usage.end()) {
    tally.usage.push_back({track.filter, track.gains, 1});
  } else {
    ++usage->scans;
  }
}

void RunMetrics::add_expected_lag(ObjectTally& tally, const TruthState& truth,
                                  const TrackEstimate& track) const {
  const ExpectedLag::Value& lag = following_.lag_of(track.id);
  tally.predicted_square += lag.position.squaredNorm();
  tally.predicted_velocity_square +=
      track.designed->noise_velocity.squaredNorm() + lag.velocity.squaredNorm();
  ++tally.expected_lags;
  if (track.residual) add_expected_innovation(tally, lag.prediction, track.gains);
  if (const double speed = truth.velocity.norm(); speed > 0.0) {
    tally.predicted_lag += lag.position.dot(truth.velocity) / speed;
  }
}

/// The length of a residual whose two components have the lag m and the standard deviation s: about
/// √(|m|² + π s² / 2), exact without lag (Rayleigh) and without noise.
void RunMetrics::add_expected_innovation(ObjectTally& tally, const Vec2& lag,
                                         const Gains& gains) const {
  if (gains.order < 1 || !is_stable(gains)) return;
  const double variance = innovation_variance(gains, options_.sigma, options_.period);
  tally.predicted_innovation += std::sqrt(lag.squaredNorm() + 0.5 * std::numbers::pi * variance);
  ++tally.predicted_innovations;
}

void RunMetrics::watch_settling(ObjectTally& tally, double error, double time) const {
  if (tally.calm_scans >= kCalmScans) return;
  if (!(error < 2.0 * options_.sigma)) {
    tally.calm_scans = 0;
    return;
  }
  if (tally.calm_scans == 0) tally.calm_since = time;
  ++tally.calm_scans;
}

ObjectReport RunMetrics::report_of(const ObjectInfo& object, const ObjectTally& tally) const {
  ObjectReport report;
  report.id = object.id;
  report.name = object.name;
  report.regime = object.regime;
  report.scans = tally.scans;
  report.detections = tally.detections;
  report.detections_used = tally.detections_used;
  report.detections_missed = tally.scans - tally.detections_used;
  report.track_changes = tally.track_changes;
  report.track_losses = tally.track_losses;
  report.tracked = tally.squared_error.count();
  report.measurement_rmse = root_mean(tally.squared_measurement_error, tally.detections);
  report.mai = mean(tally.innovation, tally.innovations);
  if (report.tracked == 0) return report;

  const auto leading =
      std::max_element(tally.usage.begin(), tally.usage.end(),
                       [](const Usage& a, const Usage& b) { return a.scans < b.scans; });
  report.filter = leading->filter;
  report.gains = to_text(leading->gains);
  report.rmse_position = std::sqrt(tally.squared_error.mean());
  if (const auto square = tally.squared_error.confidence95()) {
    report.rmse_position_ci95 =
        Interval{std::sqrt(std::max(0.0, square->low)), std::sqrt(square->high)};
  }
  if (tally.predicted_square > 0.0) {
    report.predicted_rmse = root_mean(tally.predicted_square, report.tracked);
  }
  report.floor_rmse = root_mean(
      *std::min_element(tally.floor_square.begin(), tally.floor_square.end()), tally.floor_count);
  report.rmse_velocity = root_mean(tally.squared_velocity_error, report.tracked);
  report.bias = tally.error / static_cast<double>(report.tracked);
  report.predicted_velocity = root_mean(tally.predicted_velocity_square, tally.expected_lags);
  report.predicted_mai = mean(tally.predicted_innovation, tally.predicted_innovations);
  report.peak_error = tally.peak_error;
  report.lag = tally.lag / static_cast<double>(report.tracked);
  report.predicted_lag = tally.predicted_lag / static_cast<double>(report.tracked);
  if (tally.calm_scans >= kCalmScans) report.settling_time = tally.calm_since - tally.first_time;
  if (tally.nees.count() > 0) {
    report.nees = tally.nees.mean();
    report.nees_bounds95 = chi_square_mean_bounds95(tally.nees.effective_count(), 2.0);
  }
  report.nis = mean(tally.nis, tally.nis_count);
  if (tally.nis_count > 0) {
    report.nis_bounds95 = chi_square_mean_bounds95(static_cast<double>(tally.nis_count), 2.0);
  }
  return report;
}

RunReport RunMetrics::report() const {
  RunReport report;
  report.options = options_;
  TotalReport& total = report.total;
  total = sums_;
  const auto scans = static_cast<double>(std::max<std::int64_t>(1, sums_.scans));
  for (double* sum :
       {&total.gospa, &total.gospa_localisation, &total.gospa_missed, &total.gospa_false,
        &total.ospa, &total.missed_targets, &total.false_tracks}) {
    *sum /= scans;
  }
  total.mot = mot_.result();

  double error = 0.0, velocity = 0.0, measurement = 0.0, predicted = 0.0, innovation = 0.0;
  std::int64_t tracked = 0, detections = 0, innovations = 0;
  for (const ObjectInfo& object : objects_) {
    const ObjectTally& tally = tallies_[static_cast<std::size_t>(object.id)];
    report.objects.push_back(report_of(object, tally));
    if (const std::int64_t count = tally.squared_error.count(); count > 0) {
      error += tally.squared_error.mean() * static_cast<double>(count);
      tracked += count;
    }
    velocity += tally.squared_velocity_error;
    predicted += tally.predicted_square;
    measurement += tally.squared_measurement_error;
    detections += tally.detections;
    innovation += tally.innovation;
    innovations += tally.innovations;
  }
  total.rmse_position = root_mean(error, tracked);
  total.rmse_velocity = root_mean(velocity, tracked);
  if (predicted > 0.0) total.predicted_rmse = root_mean(predicted, tracked);
  total.measurement_rmse = root_mean(measurement, detections);
  total.mai = mean(innovation, innovations);
  return report;
}

}  // namespace ghtrack

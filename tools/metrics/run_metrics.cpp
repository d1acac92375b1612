#include "tools/metrics/run_metrics.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "tools/metrics/output.hpp"
#include "tracker/filters/gain_filter.hpp"

namespace ghtrack {
namespace {

std::optional<double> root_mean(double sum, std::int64_t count) {
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

/// As many independent values have a mean of the same variance as these squares of errors, whose
/// correlations are ρ² for errors that are normally distributed: n² / Σ Σ ρ².
double effective_count(std::int64_t values, double memory) {
  const auto n = static_cast<double>(values);
  return std::max(1.0, n * n / memory);
}

/// The 95 % interval of a root mean square that shadows tell: Student's, on the scale of the
/// logarithm. @param sums  of squares over so many scans, by shadow
std::optional<Interval> rms_interval(std::span<const ExpectedError::Value::Shadow> sums,
                                     std::int64_t scans,
                                     double ExpectedError::Value::Shadow::*part) {
  constexpr auto kCount = static_cast<double>(ExpectedError::kShadows);
  double centre = 0.0, scatter = 0.0;
  for (const auto& sum : sums) centre += sum.*part / kCount;
  for (const auto& sum : sums) scatter += (sum.*part - centre) * (sum.*part - centre);
  if (!(centre > 0.0)) return std::nullopt;
  const double error = std::sqrt(scatter / (kCount - 1.0) / kCount) / centre;
  const double factor =
      std::exp(0.5 * student_quantile(0.975, ExpectedError::kShadows - 1) * error);
  const double root = std::sqrt(centre / static_cast<double>(scans));
  return Interval{root / factor, root * factor};
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
                       std::size_t contender, const std::optional<FilterTheory>& theory)
    : objects_(std::move(objects)),
      options_(options),
      contender_(contender),
      tallies_(objects_.size()),
      following_(objects_.size(), theory),
      latest_errors_(objects_.size()),
      mot_({options.gospa().cutoff, options.gospa().order}) {}

void RunMetrics::add_observation(const TruthSnapshot& truth, const Observation& observation) {
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
  if (record.contender != contender_) return;
  if (record.fate == ScanFate::kReplayed) following_.replay(record);
  if (!record.is_in_order()) return;
  gather_sets(record);
  following_.update(record);

  const std::vector<std::optional<std::size_t>> chosen = choose_tracks(record);
  std::vector<bool> is_detected(objects_.size(), false);
  for (const ObjectId origin : record.observation.origins) {
    if (origin != kClutterOrigin) is_detected.at(static_cast<std::size_t>(origin)) = true;
  }
  latest_errors_.assign(objects_.size(), std::nullopt);
  for (const TruthState& truth : record.truth.objects) {
    const auto object = static_cast<std::size_t>(truth.id);
    ObjectTally& tally = tallies_.at(object);
    if (tally.scans == 0) tally.first_time = record.truth.time;
    tally.last_time = record.truth.time;
    ++tally.scans;
    if (chosen[object]) {
      follow(truth, record.tracks.tracks[*chosen[object]], record, is_detected[object]);
    } else {
      lose(tally);
    }
  }
}

void RunMetrics::add_known(const TruthSnapshot& truth, const TrackSnapshot& tracks,
                           std::size_t contender) {
  if (contender != contender_) return;
  for (const TruthState& object : truth.objects) {
    ObjectTally& tally = tallies_.at(static_cast<std::size_t>(object.id));
    if (!tally.followed) continue;
    const auto track = std::find_if(
        tracks.tracks.begin(), tracks.tracks.end(),
        [&](const TrackEstimate& one) { return one.id == tally.track && counts_as_output(one); });
    if (track == tracks.tracks.end()) continue;
    tally.doubtful_known.push_back((track->position - object.position).squaredNorm());
    if (tally.ignored == 0) count_doubtful(tally);
  }
}

/// Scores a track in a scan, unless it has lost its object.
void RunMetrics::follow(const TruthState& truth, const TrackEstimate& track,
                        const StepRecord& record, bool is_detected) {
  ObjectTally& tally = tallies_[static_cast<std::size_t>(truth.id)];
  if (tally.track && tally.track != track.id) {
    ++tally.track_changes;
    lose(tally);
  }
  tally.track = track.id;

  const bool is_used = used_object(track, record.observation) == truth.id;
  if (is_used) {
    count_doubtful(tally);
    tally.ignored = 0;
  } else if (is_detected) {
    ++tally.ignored;
  }
  if (tally.ignored >= kLost) {
    lose(tally);
    return;
  }
  tally.followed = true;
  ScanScore score = score_of(truth, track, record.truth.time);
  score.uses_detection = is_used;
  latest_errors_[static_cast<std::size_t>(truth.id)] = score.error;
  if (tally.ignored == 0) {
    count(tally, score);
  } else {
    tally.doubtful.push_back(std::move(score));
  }
}

/// What the track has said since it last used a detection was said of something else.
void RunMetrics::lose(ObjectTally& tally) const {
  if (tally.followed) ++tally.track_losses;
  tally.followed = false;
  tally.doubtful = std::vector<ScanScore>();
  tally.doubtful_known.clear();
  if (tally.calm_scans < kCalmScans) tally.calm_scans = 0;
}

/// Of several scans at one instant the last one speaks for it, as in files.
void RunMetrics::gather_sets(const StepRecord& record) {
  if (instant_ && instant_->time != record.truth.time) score_sets();
  instant_.emplace().time = record.truth.time;
  for (const TruthState& object : record.truth.objects) {
    instant_->truth_ids.push_back(object.id);
    instant_->truth.push_back(object.position);
  }
  for (const TrackEstimate& track : record.tracks.tracks) {
    if (!counts_as_output(track)) continue;
    instant_->track_ids.push_back(track.id);
    instant_->tracks.push_back(track.position);
  }
}

void RunMetrics::score_sets() {
  if (!instant_) return;
  const auto [time, truth_ids, track_ids, truth, tracks] = *std::exchange(instant_, std::nullopt);
  if (truth.empty() && tracks.empty()) return;

  ++sums_.scans;
  const GospaResult sets = gospa(truth, tracks, options_.gospa());
  sums_.gospa += sets.gospa;
  sums_.gospa_localisation += sets.localisation;
  sums_.gospa_missed += sets.missed;
  sums_.gospa_false += sets.false_tracks;
  sums_.ospa += sets.ospa;
  sums_.switches += switches_.add(truth_ids, track_ids, sets.matches);
  for (const PointMatch& match : sets.matches) {
    squared_distance_.add(match.distance * match.distance);
  }
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
    const std::optional<ObjectId> object = following_.object_of(tracks[i]);
    if (!object || !counts_as_output(tracks[i])) continue;
    auto& best = chosen.at(static_cast<std::size_t>(*object));
    if (!best || rank(i, *object) < rank(*best, *object)) best = i;
  }
  return chosen;
}

RunMetrics::ScanScore RunMetrics::score_of(const TruthState& truth, const TrackEstimate& track,
                                           double time) const {
  ScanScore score{.time = time,
                  .error = track.position - truth.position,
                  .squared_velocity_error = (track.velocity - truth.velocity).squaredNorm(),
                  .expected = following_.expected(track, truth),
                  .filter = track.filter,
                  .gains = track.gains};
  if (const double speed = truth.velocity.norm(); speed > 0.0) {
    score.direction = truth.velocity / speed;
    score.lag = -score.error.dot(score.direction);
  }
  if (track.covariance.determinant() > 0.0) {
    score.nees = score.error.dot(track.covariance.inverse() * score.error);
  }
  if (!track.residual) return score;
  const Vec2& residual = *track.residual;
  score.innovation = residual.norm();
  if (track.innovation_covariance.determinant() > 0.0) {
    const Eigen::Matrix2d inverse = track.innovation_covariance.inverse();
    score.nis = residual.dot(inverse * residual);
    if (score.expected && score.expected->innovation) {
      const auto& [mean, covariance, length, memory] = *score.expected->innovation;
      // Of shadows, S varies with the residual, and more than their mean would be needed.
      score.expected_nis =
          memory ? (inverse * covariance).trace() + mean.dot(inverse * mean) : kNothing;
    }
  }
  return score;
}

void RunMetrics::count(ObjectTally& tally, const ScanScore& score) const {
  tally.detections_used += score.uses_detection ? 1 : 0;
  tally.squared_error.add(score.error.squaredNorm());
  tally.error += score.error;
  tally.peak_error = std::max(tally.peak_error, score.error.norm());
  watch_settling(tally, score.error.norm(), score.time);
  tally.squared_velocity_error += score.squared_velocity_error;
  tally.lag += score.lag.value_or(0.0);
  if (score.expected) {
    tally.predicted_square += score.expected->position_square();
    tally.predicted_velocity_square += score.expected->velocity_square();
    tally.shadows_tell = tally.shadows_tell || score.expected->shadows;
    tally.predicted_by_shadows.resize(ExpectedError::kShadows);
    for (std::size_t i = 0; i < ExpectedError::kShadows; ++i) {
      const auto& shadows = score.expected->shadows;
      auto& [position, velocity] = tally.predicted_by_shadows[i];
      position += shadows ? (*shadows)[i].position : score.expected->position_square();
      velocity += shadows ? (*shadows)[i].velocity : score.expected->velocity_square();
    }
    if (score.lag) tally.predicted_lag -= score.expected->position.dot(score.direction);
    ++tally.expected_scans;
    tally.nees_memory += 2.0 * score.expected->memory.value_or(kNothing) - 1.0;
  }
  if (score.expected_nis) {
    tally.predicted_innovation += score.expected->innovation->length;
    tally.predicted_nis += *score.expected_nis;
    tally.nis_memory += 2.0 * score.expected->innovation->memory.value_or(kNothing) - 1.0;
    ++tally.expected_innovations;
  }
  if (score.nees) tally.nees.add(*score.nees);
  if (score.innovation) {
    tally.innovation += *score.innovation;
    ++tally.innovations;
  }
  if (score.nis) {
    tally.nis += *score.nis;
    ++tally.nis_count;
  }
  const auto usage = std::find_if(tally.usage.begin(), tally.usage.end(), [&](const Usage& u) {
    return u.filter == score.filter && u.gains == score.gains;
  });
  if (usage == tally.usage.end()) {
    tally.usage.push_back({score.filter, score.gains, 1});
  } else {
    ++usage->scans;
  }
}

void RunMetrics::count_doubtful(ObjectTally& tally) const {
  for (const ScanScore& score : tally.doubtful) count(tally, score);
  tally.doubtful = std::vector<ScanScore>();  // of many objects, most in doubt at some time
  for (const double square : tally.doubtful_known) tally.squared_known_error.add(square);
  tally.doubtful_known.clear();
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
  report.lifetime = tally.last_time - tally.first_time;
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
  if (leading->gains) report.gains = to_text(*leading->gains);
  report.rmse_position = std::sqrt(tally.squared_error.mean());
  if (const auto square = tally.squared_error.confidence95()) {
    report.rmse_position_ci95 = Interval{std::sqrt(square->low), std::sqrt(square->high)};
  }
  report.rmse_at_clock = tally.squared_known_error.root();
  report.rmse_velocity = root_mean(tally.squared_velocity_error, report.tracked);
  report.bias = tally.error / static_cast<double>(report.tracked);
  report.peak_error = tally.peak_error;
  report.lag = tally.lag / static_cast<double>(report.tracked);
  // What is not known of every scan is not known of their mean.
  if (tally.expected_scans == report.tracked) {
    report.predicted_rmse = root_mean(tally.predicted_square, report.tracked);
    report.predicted_velocity = root_mean(tally.predicted_velocity_square, report.tracked);
    report.predicted_lag = mean(tally.predicted_lag, report.tracked);
    if (tally.shadows_tell) {
      report.predicted_rmse_ci95 = rms_interval(tally.predicted_by_shadows, report.tracked,
                                                &ExpectedError::Value::Shadow::position);
      report.predicted_velocity_ci95 = rms_interval(tally.predicted_by_shadows, report.tracked,
                                                    &ExpectedError::Value::Shadow::velocity);
    }
  }
  if (tally.expected_innovations == tally.innovations) {
    report.predicted_mai = mean(tally.predicted_innovation, tally.innovations);
    report.predicted_nis = mean(tally.predicted_nis, tally.innovations);
  }
  if (tally.calm_scans >= kCalmScans) report.settling_time = tally.calm_since - tally.first_time;
  if (tally.nees.count() > 0) {
    report.nees = tally.nees.mean();
    const bool is_foreseen =
        tally.expected_scans == tally.nees.count() && !std::isnan(tally.nees_memory);
    const double count = is_foreseen ? effective_count(tally.nees.count(), tally.nees_memory)
                                     : tally.nees.effective_count();
    report.nees_bounds95 = chi_square_mean_bounds95(count, 2.0);
  }
  report.nis = mean(tally.nis, tally.nis_count);
  if (tally.nis_count > 0) {
    const bool is_foreseen =
        tally.expected_innovations == tally.nis_count && !std::isnan(tally.nis_memory);
    const double memory = is_foreseen ? tally.nis_memory : static_cast<double>(tally.nis_count);
    report.nis_bounds95 = chi_square_mean_bounds95(effective_count(tally.nis_count, memory), 2.0);
  }
  return report;
}

RunReport RunMetrics::report() {
  score_sets();
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
  std::int64_t tracked = 0, expected = 0, detections = 0, innovations = 0;
  for (const ObjectInfo& object : objects_) {
    ObjectTally tally = tallies_[static_cast<std::size_t>(object.id)];
    count_doubtful(tally);
    report.objects.push_back(report_of(object, tally));
    if (const std::int64_t count = tally.squared_error.count(); count > 0) {
      error += tally.squared_error.mean() * static_cast<double>(count);
      tracked += count;
    }
    velocity += tally.squared_velocity_error;
    predicted += tally.predicted_square;
    expected += tally.expected_scans;
    measurement += tally.squared_measurement_error;
    detections += tally.detections;
    innovation += tally.innovation;
    innovations += tally.innovations;
  }
  total.rmse_of_pairs = squared_distance_.root();
  total.rmse_position = root_mean(error, tracked);
  total.rmse_velocity = root_mean(velocity, tracked);
  if (expected == tracked) total.predicted_rmse = root_mean(predicted, tracked);
  total.measurement_rmse = root_mean(measurement, detections);
  total.mai = mean(innovation, innovations);
  return report;
}

}  // namespace ghtrack

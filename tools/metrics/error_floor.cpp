#include "tools/metrics/error_floor.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "tracker/filters/axis_covariance.hpp"

namespace ghtrack {
namespace {

KalmanModel floor_model(std::size_t index, double sigma, double period) {
  constexpr double kDiffuse = 100.0;  // the start's uncertainty, in sigmas per period
  KalmanModel model;
  model.sigma = sigma;
  model.interval = period;
  model.process_intensity =
      intensity_of_index(model.process_model,
                         std::pow(10.0, -3.5 + static_cast<double>(index) / 3.0), sigma, period);
  model.initial_speed = kDiffuse * sigma / period;
  model.initial_acceleration = kDiffuse * sigma / (period * period);
  return model;
}

/// The variance per axis of an error that is alike in all directions.
std::optional<double> round_variance(const Eigen::Matrix2d& covariance) {
  const double variance = covariance(0, 0);
  const bool is_round = covariance(0, 1) == 0.0 && covariance(1, 0) == 0.0 &&
                        covariance(1, 1) == variance && variance >= 0.0;
  return is_round ? std::optional(variance) : std::nullopt;
}

Eigen::Array2d both(double axis) { return {axis, axis}; }

template <int Order>
void take_over(KalmanFilter<Order, 2>& filter, const RoundKalmanFilter& round) {
  const AxisCovariance<double>& p = round.covariance;
  filter.start(round.state.position);
  filter.adopt({Order, round.state,
                {both(p.xx), both(p.xv), both(p.xa), both(p.vv), both(p.va), both(p.aa)}});
}

}  // namespace

void RoundKalmanFilter::start(const KalmanModel& model, int order, const Eigen::Vector2d& z,
                              double variance) {
  state = {.position = z};
  covariance = {};
  covariance.xx = variance;
  covariance.vv = model.initial_speed * model.initial_speed;
  if (order == 2) covariance.aa = model.initial_acceleration * model.initial_acceleration;
}

void RoundKalmanFilter::predict(const KalmanModel& model, int order, double dt) {
  state = extrapolated(state, dt);
  covariance = extrapolated(covariance, dt);
  covariance +=
      process_noise(model.process_model, order, model.process_intensity, dt, model.renewal);
}

void RoundKalmanFilter::update(const Eigen::Vector2d& z, double variance) {
  const double predicted = covariance.xx + variance;
  if (!(predicted > 0.0)) return;
  const Eigen::Vector2d residual = z - state.position;
  const AxisGain<double> gain{covariance.xx / predicted, covariance.xv / predicted,
                              covariance.xa / predicted};
  state.position += gain.x * residual;
  state.velocity += gain.v * residual;
  state.acceleration += gain.a * residual;
  covariance = corrected(covariance, gain, variance);
}

FloorFilters::FloorFilters(double sigma, double period) {
  Design design;
  for (std::size_t i = 0; i < kNoises; ++i) {
    design.models[i] = floor_model(i, sigma, period);
    design.not_started.velocity.emplace_back(design.models[i]);
    design.not_started.acceleration.emplace_back(design.models[i]);
  }
  design_ = std::make_shared<const Design>(std::move(design));
}

void FloorFilters::step(double time, const Detection* detection) {
  const double dt = time - time_;
  time_ = time;
  if (dt > 0.0) {  // not between two sensors at one instant
    if (auto* const round = std::get_if<Round>(&filters_)) {
      for (std::size_t i = 0; i < kFilters; ++i) (*round)[i].predict(model_of(i), order_of(i), dt);
    } else if (auto* const general = std::get_if<General>(&filters_)) {
      for (auto& filter : general->velocity) filter.predict(dt);
      for (auto& filter : general->acceleration) filter.predict(dt);
    }
  }
  if (detection == nullptr) return;
  if (++detections_ == 1) {
    start(*detection);
  } else {
    update(*detection);
  }
}

void FloorFilters::start(const Detection& detection) {
  if (const auto variance = round_variance(detection.covariance)) {
    Round& round = filters_.emplace<Round>();
    for (std::size_t i = 0; i < kFilters; ++i) {
      round[i].start(model_of(i), order_of(i), detection.position, *variance);
    }
    return;
  }
  General& general = filters_.emplace<General>(design_->not_started);
  for (auto& filter : general.velocity) filter.start(detection.position, detection.covariance);
  for (auto& filter : general.acceleration) filter.start(detection.position, detection.covariance);
}

void FloorFilters::update(const Detection& detection) {
  const std::optional<double> variance = round_variance(detection.covariance);
  if (auto* const round = std::get_if<Round>(&filters_); round != nullptr && variance) {
    for (RoundKalmanFilter& filter : *round) filter.update(detection.position, *variance);
    return;
  }
  if (auto* const round = std::get_if<Round>(&filters_)) filters_ = general_of(*round);
  General& general = std::get<General>(filters_);
  for (auto& filter : general.velocity) filter.update(detection.position, detection.covariance);
  for (auto& filter : general.acceleration) filter.update(detection.position, detection.covariance);
}

FloorFilters::General FloorFilters::general_of(const Round& round) const {
  General general = design_->not_started;
  for (std::size_t i = 0; i < kNoises; ++i) {
    take_over(general.velocity[i], round[i]);
    take_over(general.acceleration[i], round[kNoises + i]);
  }
  return general;
}

std::optional<FloorFilters::Values> FloorFilters::squared_errors(
    const Eigen::Vector2d& truth) const {
  if (detections_ < 3) return std::nullopt;
  Values errors{};
  const auto of = [&](const Kinematics<2>& state) { return (state.position - truth).squaredNorm(); };
  if (const auto* const round = std::get_if<Round>(&filters_)) {
    for (std::size_t i = 0; i < kFilters; ++i) errors[i] = of((*round)[i].state);
  } else {
    const General& general = std::get<General>(filters_);
    for (std::size_t i = 0; i < kNoises; ++i) {
      errors[i] = of(general.velocity[i].estimate());
      errors[kNoises + i] = of(general.acceleration[i].estimate());
    }
  }
  return errors;
}

ErrorFloor::ErrorFloor(std::size_t objects, double sigma, double period)
    : filters_(objects, FloorFilters(sigma, period)) {}

void ErrorFloor::add_observation(const TruthSnapshot& truth, const Observation& observation) {
  const Scan& scan = observation.scan;
  std::vector<const Detection*> detection_of(filters_.size(), nullptr);
  for (std::size_t i = 0; i < observation.origins.size(); ++i) {
    const ObjectId origin = observation.origins[i];
    if (origin == kClutterOrigin) continue;
    detection_of.at(static_cast<std::size_t>(origin)) = &scan.detections[i];
  }
  ScanErrors errors{.time = scan.time, .sensor = scan.sensor, .of_objects = {}};
  errors.of_objects.resize(filters_.size());
  for (const TruthState& state : truth.objects) {
    const auto object = static_cast<std::size_t>(state.id);
    filters_.at(object).step(scan.time, detection_of[object]);
    errors.of_objects[object] = filters_[object].squared_errors(state.position);
  }
  waiting_.push_back(std::move(errors));
}

void ErrorFloor::go_to(double time, int sensor) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const ScanErrors& scan) {
    return std::tie(scan.time, scan.sensor) >= std::tie(time, sensor);
  });
  current_.reset();
  if (found != waiting_.end() && found->time == time && found->sensor == sensor) {
    current_ = std::move(*found);
    waiting_.erase(waiting_.begin(), found + 1);
  } else {
    waiting_.erase(waiting_.begin(), found);
  }
}

std::optional<FloorFilters::Values> ErrorFloor::squared_errors(ObjectId object) const {
  if (!current_) return std::nullopt;
  return current_->of_objects.at(static_cast<std::size_t>(object));
}

}  // namespace ghtrack

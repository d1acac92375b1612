#include "tools/metrics/error_floor.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "tracker/filters/axis_covariance.hpp"

namespace ghtrack {
namespace {

/// One filter of the given order for each process noise.
template <int Order>
std::vector<KalmanFilter<Order, 2>> filters_of(double sigma, double period) {
  constexpr double kDiffuse = 100.0;  // the start's uncertainty, in sigmas per period
  std::vector<KalmanFilter<Order, 2>> filters;
  for (std::size_t i = 0; i < FloorFilters::kNoises; ++i) {
    KalmanModel model;
    model.sigma = sigma;
    model.interval = period;
    const double index = std::pow(10.0, -3.5 + static_cast<double>(i) / 3.0);
    model.process_intensity = intensity_of_index(model.process_model, index, sigma, period);
    model.initial_speed = kDiffuse * sigma / period;
    model.initial_acceleration = kDiffuse * sigma / (period * period);
    filters.emplace_back(model);
  }
  return filters;
}

}  // namespace

FloorFilters::FloorFilters(double sigma, double period)
    : velocity_(filters_of<1>(sigma, period)), acceleration_(filters_of<2>(sigma, period)) {}

void FloorFilters::step(double time, const Detection* detection) {
  const double dt = time - time_;
  time_ = time;
  const auto advance = [&](auto& filter) {
    if (dt > 0.0) filter.predict(dt);  // not between two sensors at one instant
    if (detection != nullptr) filter.update(detection->position, detection->covariance);
  };
  if (detection != nullptr) ++detections_;
  for (auto& filter : velocity_) advance(filter);
  for (auto& filter : acceleration_) advance(filter);
}

std::optional<FloorFilters::Values> FloorFilters::squared_errors(
    const Eigen::Vector2d& truth) const {
  if (detections_ < 3) return std::nullopt;
  Values errors{};
  for (std::size_t i = 0; i < kNoises; ++i) {
    errors[i] = (velocity_[i].estimate().position - truth).squaredNorm();
    errors[kNoises + i] = (acceleration_[i].estimate().position - truth).squaredNorm();
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

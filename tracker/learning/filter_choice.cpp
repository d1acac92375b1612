#include "tracker/learning/filter_choice.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kClearly = 5.0;          // in ln p, and
constexpr double kClearlyPerFix = 0.005;  // for each detection

constexpr double kSeldom = 0.01;  // probability of a change of motion, for what leaves a filter

double typical_sigma(std::span<const Eigen::Vector2d> variance) {
  double least = variance.front().prod();
  for (const Eigen::Vector2d& v : variance) least = std::min(least, v.prod());
  return portable::pow(least, 0.25);
}

KalmanCvConfig steady(double density, double initial_speed) {
  KalmanCvConfig config;
  config.model = process::WhiteNoise<1>{.spectral_density = density};
  config.initial_speed = initial_speed;
  return config;
}

KalmanCaConfig accelerating(double density, double initial_speed, double initial_acceleration) {
  KalmanCaConfig config;
  config.model = process::WhiteNoise<2>{.spectral_density = density};
  config.initial_speed = initial_speed;
  config.initial_acceleration = initial_acceleration;
  return config;
}

ImmConfig mixed(const std::vector<std::pair<const char*, double>>& densities, double initial_speed,
                double switching = ImmConfig().switching) {
  ImmConfig config;
  config.switching = switching;
  for (const auto& [name, density] : densities) {
    config.filters[name] = steady(density, initial_speed);
  }
  return config;
}

/// Of white noise that turns the velocity round in an interval.
double nimblest(double process_density, double initial_speed, double interval) {
  return std::max(10.0 * process_density, 4.0 * initial_speed * initial_speed / interval);
}

}  // namespace

ImmConfig bank(double process_density, double initial_speed, double interval) {
  const double most = nimblest(process_density, initial_speed, interval);
  return mixed({{"steady", 0.01 * process_density}, {"turning", process_density}, {"nimble", most}},
               initial_speed);
}

double log_likelihood(const FilterConfig& config, std::span<const Path* const> paths,
                      std::span<const Eigen::Vector2d> variance, double interval) {
  const Filter waiting = make_filter(config, typical_sigma(variance), interval);
  const auto covariance = [&](const Fix& fix) -> Eigen::Matrix2d {
    const bool is_said = !fix.variance.isZero(0.0);
    return (is_said ? fix.variance : variance[static_cast<std::size_t>(fix.sensor)]).asDiagonal();
  };
  double sum = 0.0;
  for (const Path* path : paths) {
    Filter filter = waiting;
    start(filter, path->fixes.front().position, covariance(path->fixes.front()));
    for (std::size_t i = 1; i < path->fixes.size(); ++i) {
      const Fix& fix = path->fixes[i];
      const double elapsed = fix.time - path->fixes[i - 1].time;
      if (elapsed > 0.0) predict(filter, elapsed);
      const Eigen::Matrix2d noise = covariance(fix);
      sum += log_likelihood(filter, fix.position, noise).value_or(0.0);
      update(filter, fix.position, noise);
    }
  }
  return sum;
}

FilterChoice choose_filter(std::span<const Path* const> paths,
                           std::span<const Eigen::Vector2d> variance, double process_density,
                           double initial_speed, double interval) {
  constexpr std::size_t kMostFixes = 500;
  std::vector<const Path*> enough;
  std::size_t fixes = 0;
  for (const Path* path : paths) fixes += path->fixes.size();
  const std::size_t stride = std::max<std::size_t>(1, fixes / kMostFixes);
  for (std::size_t i = 0; i < paths.size(); i += stride) enough.push_back(paths[i]);

  const double q = process_density;
  FilterChoice best{.filter = steady(q, initial_speed)};
  const double usual = log_likelihood(best.filter, enough, variance, interval);
  const double clearly = kClearly + kClearlyPerFix * static_cast<double>(fixes / stride);
  const auto consider = [&](const FilterConfig& rival) {
    const double gain = log_likelihood(rival, enough, variance, interval) - usual;
    if (gain > std::max(clearly, best.gain + kClearly)) best = {rival, gain};
  };
  const double acceleration = std::sqrt(q / interval);
  for (const double jerkiness : {0.003, 0.1}) {
    consider(accelerating(jerkiness * q / (interval * interval), initial_speed, acceleration));
  }
  const double most = nimblest(q, initial_speed, interval);
  consider(mixed({{"steady", 0.1 * q}, {"nimble", 10.0 * q}}, initial_speed));
  consider(mixed({{"steady", 0.01 * q}, {"nimble", most}}, initial_speed, kSeldom));
  return best;
}

}  // namespace ghtrack

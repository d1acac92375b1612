#include "tracker/filters/filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/portable_math.hpp"
#include "tracker/filters/filter_design.hpp"

namespace ghtrack {
namespace {

template <int Order>
SingleFilter make(const GainFilterConfig<Order>& config, double sigma, double dt) {
  const GainDesign design = designed(config, sigma, dt);
  return GainFilter<2>(design.schedule, design.errors);
}

template <int Order>
SingleFilter make(const KalmanConfig<Order>& config, double sigma, double dt) {
  return KalmanFilter<Order, 2>(designed(config, sigma, dt));
}

template <Propagation Way>
SingleFilter make(const MotionFilterConfig<Way>& config, double sigma, double dt) {
  return equivalent_motion(config, sigma, dt);
}

/// From one that hardly manoeuvres to one that follows the measurements.
std::map<std::string, SingleFilterConfig> bank_of_indices() {
  std::map<std::string, SingleFilterConfig> bank;
  const std::array<std::pair<const char*, double>, 3> indices = {
      {{"steady", 0.01}, {"turning", 0.3}, {"nimble", 10.0}}};
  for (const auto& [name, index] : indices) {
    bank[name] = GhConfig{.design = gain_design::TrackingIndex<1>{.index = index}};
  }
  return bank;
}

}  // namespace

const std::map<std::string, SingleFilterConfig>& bank_of(const MultipleModelConfig& config) {
  return config.filters;
}

const std::map<std::string, SingleFilterConfig>& bank_of(const ImmConfig& config) {
  static const std::map<std::string, SingleFilterConfig> by_default = bank_of_indices();
  return config.filters.empty() ? by_default : config.filters;
}

namespace {

ImmFilter make(const ImmConfig& config, double sigma, double dt) {
  std::vector<ImmFilter::Mode> modes;
  for (const auto& [label, filter] : bank_of(config)) {
    modes.push_back({label, equivalent_motion(filter, sigma, dt)});
  }
  return ImmFilter(std::move(modes), config.switching);
}

MultipleModelFilter make(const MultipleModelConfig& config, double sigma, double dt) {
  std::vector<MultipleModelFilter::Model> models;
  for (const auto& [label, filter] : config.filters) {
    models.push_back(
        {label, std::visit([&](const auto& chosen) { return make(chosen, sigma, dt); }, filter)});
  }
  return MultipleModelFilter(std::move(models), config.switching);
}

/// ln Σ c_j N(r_j; 0, S_j).
double log_likelihood_of_mixture(const ImmFilter& mixed, const Eigen::Vector2d& z,
                                 const Eigen::Matrix2d& covariance) {
  double density = 0.0;
  for (const ImmFilter::Mode& mode : mixed.modes()) {
    const Eigen::Matrix2d s = mode.filter.innovation_covariance(covariance);
    const Eigen::Vector2d r = z - mode.filter.estimate().position;
    density += mode.weight * portable::exp(-0.5 * r.dot(s.inverse() * r)) /
               (2.0 * std::numbers::pi * std::sqrt(s.determinant()));
  }
  return portable::log(std::max(density, std::numeric_limits<double>::min()));
}

}  // namespace

Filter make_filter(const FilterConfig& config, double sigma, double dt) {
  require_measurable(sigma, dt);
  return std::visit(
      [&](const auto& chosen) {
        const auto widened = [](auto&& made) { return Filter(std::forward<decltype(made)>(made)); };
        const auto made = make(chosen, sigma, dt);
        if constexpr (std::is_same_v<decltype(made), const SingleFilter>) {
          return std::visit(widened, made);
        } else {
          return widened(made);
        }
      },
      config);
}

bool start(Filter& filter, const Eigen::Vector2d& z, const Eigen::Matrix2d& covariance) {
  return std::visit([&](auto& f) { return f.start(z, covariance); }, filter);
}

bool predict(Filter& filter, double dt) {
  return std::visit([dt](auto& f) { return f.predict(dt); }, filter);
}

bool update(Filter& filter, const Eigen::Vector2d& z) {
  return std::visit([&](auto& f) { return f.update(z); }, filter);
}

bool update(Filter& filter, const Eigen::Vector2d& z, const Eigen::Matrix2d& covariance) {
  return std::visit([&](auto& f) { return f.update(z, covariance); }, filter);
}

bool update(Filter& filter, const Eigen::Vector2d& z, const Eigen::Matrix2d& covariance,
            const std::optional<Measurement>& measured) {
  return std::visit(
      [&](auto& f) {
        if constexpr (requires { f.update(*measured); }) {
          if (measured && f.is_started()) return f.update(*measured);
        }
        return f.update(z, covariance);
      },
      filter);
}

bool update(Filter& filter, const Detection& detection) {
  return update(filter, detection.position, detection.covariance, detection.measured);
}

std::optional<double> log_likelihood(const Filter& filter, const Eigen::Vector2d& z,
                                     const Eigen::Matrix2d& covariance) {
  if (const auto* mixed = std::get_if<ImmFilter>(&filter)) {
    return log_likelihood_of_mixture(*mixed, z, covariance);
  }
  const Eigen::Matrix2d s = innovation_covariance(filter, covariance);
  const double determinant = s.determinant();
  if (!(determinant > 0.0)) return std::nullopt;
  const Eigen::Vector2d r = z - estimate(filter).position;
  const double nis = r.dot(s.inverse() * r);
  return -0.5 * (nis + portable::log(determinant)) - portable::log(2.0 * std::numbers::pi);
}

void coast(Filter& filter) {
  std::visit([](auto& f) { f.coast(); }, filter);
}

bool is_started(const Filter& filter) {
  return std::visit([](const auto& f) { return f.is_started(); }, filter);
}

int updates(const Filter& filter) {
  return std::visit([](const auto& f) { return f.updates(); }, filter);
}

int consecutive_misses(const Filter& filter) {
  return std::visit([](const auto& f) { return f.consecutive_misses(); }, filter);
}

Refusals refusals(const Filter& filter) {
  return std::visit([](const auto& f) { return f.refusals(); }, filter);
}

const Kinematics<2>& prior(const Filter& filter) {
  return std::visit([](const auto& f) -> const Kinematics<2>& { return f.prior(); }, filter);
}

const Kinematics<2>& estimate(const Filter& filter) {
  return std::visit([](const auto& f) -> const Kinematics<2>& { return f.estimate(); }, filter);
}

const std::optional<Eigen::Vector2d>& residual(const Filter& filter) {
  return std::visit(
      [](const auto& f) -> const std::optional<Eigen::Vector2d>& { return f.residual(); }, filter);
}

Eigen::Vector2d position_sigma(const Filter& filter) {
  return std::visit([](const auto& f) { return f.position_sigma(); }, filter);
}

Eigen::Vector2d noise_sigma(const Filter& filter) {
  if (const auto* several = std::get_if<MultipleModelFilter>(&filter)) {
    return several->noise_sigma();
  }
  if (const auto* gains = designed_gain_filter(filter)) return gains->noise_sigma();
  return position_sigma(filter);
}

Eigen::Matrix2d position_covariance(const Filter& filter) {
  return innovation_covariance(filter, Eigen::Matrix2d::Zero());
}

Eigen::Matrix2d innovation_covariance(const Filter& filter, const Eigen::Matrix2d& measurement) {
  return std::visit([&](const auto& f) { return f.innovation_covariance(measurement); }, filter);
}

Eigen::Matrix2d innovation_covariance(const Filter& filter) {
  return std::visit([](const auto& f) { return f.innovation_covariance(); }, filter);
}

std::string_view name(const Filter& filter) {
  return std::visit([](const auto& f) { return f.name(); }, filter);
}

std::string_view model_name(const Filter& filter) {
  if (const auto* several = std::get_if<MultipleModelFilter>(&filter))
    return several->leader().name;
  if (const auto* mixed = std::get_if<ImmFilter>(&filter)) return mixed->leader().name;
  return {};
}

const GainFilter<2>* designed_gain_filter(const Filter& filter) {
  if (const auto* several = std::get_if<MultipleModelFilter>(&filter)) {
    return std::get_if<GainFilter<2>>(&several->leader().filter);
  }
  return std::get_if<GainFilter<2>>(&filter);
}

namespace {

/// What a filter that settles at constant gains says of itself.
template <class Result, class Of>
std::optional<Result> if_it_settles(const Filter& filter, Of&& of) {
  return std::visit(
      [&](const auto& f) -> std::optional<Result> {
        if constexpr (SettlesAtGains<std::decay_t<decltype(f)>>) return of(f);
        return std::nullopt;
      },
      filter);
}

}  // namespace

std::string gains_text(const Filter& filter) {
  return if_it_settles<std::string>(filter, [](const auto& f) { return f.gains_text(); })
      .value_or("");
}

std::optional<Gains> steady_gains(const Filter& filter) {
  return if_it_settles<Gains>(filter, [](const auto& f) { return f.steady_gains(); });
}

std::optional<Lag> steady_lag(const Filter& filter, double next_derivative) {
  return if_it_settles<Lag>(filter, [&](const auto& f) {
    return steady_lag(f.steady_gains(), f.nominal_interval(), next_derivative);
  });
}

std::optional<double> predicted_rmse(const Filter& filter, double next_derivative) {
  return if_it_settles<double>(filter, [&](const auto& f) {
    return predicted_rmse(f.steady_gains(), f.sigma(), f.nominal_interval(), next_derivative);
  });
}

}  // namespace ghtrack

#include "tracker/filters/filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>

#include "sim/portable_math.hpp"
#include "tracker/filters/filter_design.hpp"

namespace ghtrack {
namespace {

/// ln Σ c_j N(r_j; 0, S_j).
double log_likelihood_of_mixture(const ImmFilter<2>& mixed, const Eigen::Vector2d& z,
                                 const Eigen::Matrix2d& covariance) {
  double density = 0.0;
  for (const ImmFilter<2>::Mode& mode : mixed.modes()) {
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
        if constexpr (requires { bank_of(chosen); }) {
          return Filter(make_bank<2>(chosen, sigma, dt));
        } else {
          return std::visit([](auto&& made) { return Filter(std::move(made)); },
                            make_single_filter<2>(chosen, sigma, dt));
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
  if (const auto* mixed = std::get_if<ImmFilter<2>>(&filter)) {
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
  if (const auto* several = std::get_if<MultipleModelFilter<2>>(&filter)) {
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
  if (const auto* several = std::get_if<MultipleModelFilter<2>>(&filter))
    return several->leader().name;
  if (const auto* mixed = std::get_if<ImmFilter<2>>(&filter)) return mixed->leader().name;
  return {};
}

const GainFilter<2>* designed_gain_filter(const Filter& filter) {
  if (const auto* several = std::get_if<MultipleModelFilter<2>>(&filter)) {
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

std::string title(const Filter& filter) {
  if (std::holds_alternative<MultipleModelFilter<2>>(filter)) {
    return std::string(MultipleModelConfig::kind);
  }
  const std::string gains = gains_text(filter);
  return std::string(name(filter)) + (gains.empty() ? "" : " " + gains);
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

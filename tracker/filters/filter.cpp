#include "tracker/filters/filter.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace ghtrack {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// How the gains of a rule follow the interval, and the process noise that it assumes.
template <int Order>
void apply_rule(const gain_design::TrackingIndex<Order>& rule, GainSchedule& schedule,
                ErrorModel& errors) {
  const double index = rule.index_at(errors.sigma, schedule.interval);
  schedule.law = IndexLaw{index, rule.model};
  errors.process_model = rule.model;
  errors.process_intensity = intensity_of_index(rule.model, index, errors.sigma, schedule.interval);
}

void apply_rule(const auto& rule, GainSchedule& schedule, ErrorModel&) {
  if constexpr (requires { rule.theta; }) schedule.law = MemoryLaw{rule.theta};
}

void require_stable(const Gains& gains) {
  if (const auto violated = violated_inequality(gains)) {
    throw std::invalid_argument("unstable gains " + to_text(gains) + ": " + std::string(*violated) +
                                " does not hold");
  }
}

template <int Order>
SingleFilter make(const GainFilterConfig<Order>& config, double sigma, double dt) {
  GainSchedule schedule{.interval = dt,
                        .source = config.source(),
                        .start_up = config.start_up.value_or(StartUp::kGrowingMemory)};
  ErrorModel errors{.sigma = sigma,
                    .initial_speed = config.initial_speed,
                    .initial_acceleration = config.initial_acceleration,
                    .huber = config.huber.value_or(kNoLimit)};
  std::visit(
      [&](const auto& rule) {
        schedule.steady = rule.gains(sigma, dt);
        apply_rule(rule, schedule, errors);
      },
      config.design);
  require_stable(schedule.steady);
  schedule.irregular_time = config.irregular_time.value_or(
      config.has_time_scale() ? IrregularTime::kGainsFromElapsed : IrregularTime::kFixedGains);
  if (config.allowed_acceleration) {
    errors.process_model = ProcessModel::kPiecewiseConstant;
    errors.process_intensity = *config.allowed_acceleration;
  }
  return GainFilter<2>(schedule, errors);
}

template <int Order>
SingleFilter make(const KalmanConfig<Order>& config, double sigma, double dt) {
  KalmanModel model{.sigma = sigma,
                    .interval = dt,
                    .initial_speed = config.initial_speed,
                    .initial_acceleration = config.initial_acceleration,
                    .huber = config.huber.value_or(kNoLimit)};
  std::visit(
      [&model](const auto& process) {
        model.process_model = process.model;
        model.process_intensity = process.intensity();
      },
      config.model);
  return KalmanFilter<Order, 2>(model);
}

MultipleModelFilter make(const MultipleModelConfig& config, double sigma, double dt) {
  std::vector<MultipleModelFilter::Model> models;
  for (const auto& [label, filter] : config.filters) {
    models.push_back(
        {label, std::visit([&](const auto& chosen) { return make(chosen, sigma, dt); }, filter)});
  }
  return MultipleModelFilter(std::move(models), config.switching);
}

}  // namespace

Filter make_filter(const FilterConfig& config, double sigma, double dt) {
  if (!(sigma > 0.0) || !std::isfinite(sigma)) {
    throw std::invalid_argument("a filter needs a positive measurement error");
  }
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    throw std::invalid_argument("a filter needs a positive time between updates");
  }
  return std::visit(
      [&](const auto& chosen) {
        const auto widened = [](auto&& made) { return Filter(std::forward<decltype(made)>(made)); };
        const auto made = make(chosen, sigma, dt);
        if constexpr (std::is_same_v<decltype(made), const MultipleModelFilter>) {
          return widened(made);
        } else {
          return std::visit(widened, made);
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
  const auto* several = std::get_if<MultipleModelFilter>(&filter);
  return several != nullptr ? several->leader().name : std::string_view();
}

const GainFilter<2>* designed_gain_filter(const Filter& filter) {
  if (const auto* several = std::get_if<MultipleModelFilter>(&filter)) {
    return std::get_if<GainFilter<2>>(&several->leader().filter);
  }
  return std::get_if<GainFilter<2>>(&filter);
}

std::string gains_text(const Filter& filter) {
  return std::visit([](const auto& f) { return f.gains_text(); }, filter);
}

Gains steady_gains(const Filter& filter) {
  return std::visit([](const auto& f) { return f.steady_gains(); }, filter);
}

Lag steady_lag(const Filter& filter, double next_derivative) {
  return std::visit(
      [&](const auto& f) {
        return steady_lag(f.steady_gains(), f.nominal_interval(), next_derivative);
      },
      filter);
}

double predicted_rmse(const Filter& filter, double next_derivative) {
  return std::visit(
      [&](const auto& f) {
        return predicted_rmse(f.steady_gains(), f.sigma(), f.nominal_interval(), next_derivative);
      },
      filter);
}

}  // namespace ghtrack

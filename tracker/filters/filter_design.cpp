#include "tracker/filters/filter_design.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tracker/filters/gains/analysis.hpp"

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

}  // namespace

void require_measurable(double sigma, double dt) {
  if (!(sigma > 0.0) || !std::isfinite(sigma)) {
    throw std::invalid_argument("a filter needs a positive measurement error");
  }
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    throw std::invalid_argument("a filter needs a positive time between updates");
  }
}

template <int Order, gain_design::Stability S>
GainDesign designed(const GainFilterConfig<Order, S>& config, double sigma, double dt) {
  GainSchedule schedule{.interval = dt,
                        .source = config.source(),
                        .start_up = config.start_up.value_or(StartUp::kGrowingMemory)};
  ErrorModel errors{.sigma = sigma,
                    .initial_speed = config.initial_speed,
                    .initial_acceleration = config.initial_acceleration,
                    .renewal = dt,
                    .huber = config.huber.value_or(kNoLimit)};
  std::visit(
      [&](const auto& rule) {
        schedule.steady = rule.gains(sigma, dt);
        apply_rule(rule, schedule, errors);
      },
      config.design);
  if (S == gain_design::Stability::kRequired) require_stable(schedule.steady);
  schedule.irregular_time = config.irregular_time.value_or(IrregularTime::kGainsFromCovariance);
  if (config.allowed_acceleration) {
    errors.process_model = ProcessModel::kPiecewiseConstant;
    errors.process_intensity = *config.allowed_acceleration;
  }
  return {schedule, errors};
}

template <int Order>
KalmanModel designed(const KalmanConfig<Order>& config, double sigma, double dt) {
  KalmanModel model{.sigma = sigma,
                    .interval = dt,
                    .renewal = dt,
                    .initial_speed = config.initial_speed,
                    .initial_acceleration = config.initial_acceleration,
                    .huber = config.huber.value_or(kNoLimit)};
  std::visit(
      [&model](const auto& process) {
        model.process_model = process.model;
        model.process_intensity = process.intensity();
      },
      config.model);
  return model;
}

template GainDesign designed(const Order0Config&, double, double);
template GainDesign designed(const GhConfig&, double, double);
template GainDesign designed(const GhkConfig&, double, double);
template GainDesign designed(const FreeGains<0>&, double, double);
template GainDesign designed(const FreeGains<1>&, double, double);
template GainDesign designed(const FreeGains<2>&, double, double);
template KalmanModel designed(const KalmanConfig<1>&, double, double);
template KalmanModel designed(const KalmanConfig<2>&, double, double);

namespace {

template <int Order>
TargetMotion motion_of(const motion::NearlyConstant<Order>& chosen, double initial_acceleration) {
  return PolynomialMotion{.order = Order,
                          .process_intensity = chosen.spectral_density,
                          .initial_acceleration = initial_acceleration};
}
TargetMotion motion_of(const CoordinatedTurn& chosen, double) { return chosen; }
TargetMotion motion_of(const Ballistic& chosen, double) { return chosen; }

template <int Order>
MotionModel mode_of(const GainFilterConfig<Order>& config, double sigma, double dt) {
  const auto& [schedule, errors] = designed(config, sigma, dt);
  PolynomialMotion motion{.order = Order,
                          .process_model = errors.process_model,
                          .process_intensity = errors.process_intensity,
                          .renewal = dt,
                          .initial_acceleration = errors.initial_acceleration};
  if (schedule.source == GainSource::kTable) {
    motion.process_intensity = 0.0;
    motion.implied = implied_noise(schedule.steady, sigma, dt);
  }
  return {.motion = motion, .sigma = sigma, .interval = dt, .initial_speed = errors.initial_speed};
}

template <int Order>
MotionModel mode_of(const KalmanConfig<Order>& config, double sigma, double dt) {
  const KalmanModel model = designed(config, sigma, dt);
  return {.motion = PolynomialMotion{.order = Order,
                                     .process_model = model.process_model,
                                     .process_intensity = model.process_intensity,
                                     .renewal = dt,
                                     .initial_acceleration = model.initial_acceleration},
          .sigma = sigma,
          .interval = dt,
          .initial_speed = model.initial_speed};
}

template <Propagation Way>
MotionModel mode_of(const MotionFilterConfig<Way>& config, double sigma, double dt) {
  const auto motion =
      std::visit([&](const auto& chosen) { return motion_of(chosen, config.initial_acceleration); },
                 config.motion);
  return {.motion = motion,
          .propagation = Way,
          .sigma = sigma,
          .interval = dt,
          .initial_speed = config.initial_speed};
}

}  // namespace

MotionModel equivalent_motion(const SingleFilterConfig& config, double sigma, double dt) {
  require_measurable(sigma, dt);
  return std::visit([&](const auto& chosen) { return mode_of(chosen, sigma, dt); }, config);
}

namespace {

template <int D, int Order>
SingleFilter<D> single(const GainFilterConfig<Order>& config, double sigma, double dt) {
  const GainDesign design = designed(config, sigma, dt);
  return GainFilter<D>(design.schedule, design.errors);
}

template <int D, int Order>
SingleFilter<D> single(const KalmanConfig<Order>& config, double sigma, double dt) {
  return KalmanFilter<Order, D>(designed(config, sigma, dt));
}

template <int D, Propagation Way>
SingleFilter<D> single(const MotionFilterConfig<Way>& config, double sigma, double dt) {
  return MotionFilter<D>(mode_of(config, sigma, dt));
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

template <int D>
SingleFilter<D> make_single_filter(const SingleFilterConfig& config, double sigma, double dt) {
  return std::visit([&](const auto& chosen) { return single<D>(chosen, sigma, dt); }, config);
}

template <int D>
MultipleModelFilter<D> make_bank(const MultipleModelConfig& config, double sigma, double dt) {
  std::vector<typename MultipleModelFilter<D>::Model> models;
  for (const auto& [label, filter] : bank_of(config)) {
    models.push_back({label, make_single_filter<D>(filter, sigma, dt)});
  }
  return MultipleModelFilter<D>(std::move(models), config.switching);
}

template <int D>
ImmFilter<D> make_bank(const ImmConfig& config, double sigma, double dt) {
  std::vector<typename ImmFilter<D>::Mode> modes;
  for (const auto& [label, filter] : bank_of(config)) {
    modes.push_back({label, MotionFilter<D>(equivalent_motion(filter, sigma, dt))});
  }
  return ImmFilter<D>(std::move(modes), config.switching);
}

template SingleFilter<1> make_single_filter<1>(const SingleFilterConfig&, double, double);
template SingleFilter<2> make_single_filter<2>(const SingleFilterConfig&, double, double);
template MultipleModelFilter<1> make_bank<1>(const MultipleModelConfig&, double, double);
template MultipleModelFilter<2> make_bank<2>(const MultipleModelConfig&, double, double);
template ImmFilter<1> make_bank<1>(const ImmConfig&, double, double);
template ImmFilter<2> make_bank<2>(const ImmConfig&, double, double);

}  // namespace ghtrack

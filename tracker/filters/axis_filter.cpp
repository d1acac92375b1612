#include "tracker/filters/axis_filter.hpp"

#include "tracker/filters/filter_design.hpp"

namespace ghtrack {
namespace {

template <class F>
F from_guess(F filter, const std::optional<Kinematics<1>>& guess) {
  if (guess) filter.start_from(*guess);
  return filter;
}

template <int Order>
AxisFilter make(const GainFilterConfig<Order>& config, double sigma, double dt,
                const std::optional<Kinematics<1>>& guess) {
  const GainDesign design = designed(config, sigma, dt);
  return from_guess(GainFilter<1>(design.schedule, design.errors), guess);
}

template <int Order>
AxisFilter make(const KalmanConfig<Order>& config, double sigma, double dt,
                const std::optional<Kinematics<1>>& guess) {
  return from_guess(KalmanFilter<Order, 1>(designed(config, sigma, dt)), guess);
}

AxisFilter make(const LeastSquaresConfig& config, double sigma, double dt,
                const std::optional<Kinematics<1>>& guess) {
  return LeastSquaresFilter<1>(config.order, dt, sigma, guess.value_or(Kinematics<1>()));
}

AxisFilter make(const ScalarKalmanConfig& config, double, double,
                const std::optional<Kinematics<1>>& guess) {
  return ScalarKalmanFilter({guess ? guess->position[0] : 0.0, config.p0},
                            {.control = config.u, .process_variance = config.q}, config.r);
}

AxisFilter make(const DiscreteBayesConfig& config, double, double,
                const std::optional<Kinematics<1>>&) {
  return DiscreteBayesFilter(config);
}

template <int Order>
int order_of_one(const GainFilterConfig<Order>&) {
  return Order;
}
template <int Order>
int order_of_one(const KalmanConfig<Order>&) {
  return Order;
}
int order_of_one(const LeastSquaresConfig& config) { return config.order; }
int order_of_one(const ScalarKalmanConfig&) { return 0; }
int order_of_one(const DiscreteBayesConfig&) { return 0; }

}  // namespace

AxisFilter make_axis_filter(const AxisFilterConfig& config, double sigma, double dt,
                            const std::optional<Kinematics<1>>& guess) {
  require_measurable(sigma, dt);
  return std::visit([&](const auto& chosen) { return make(chosen, sigma, dt, guess); }, config);
}

int order_of(const AxisFilterConfig& config) {
  return std::visit([](const auto& chosen) { return order_of_one(chosen); }, config);
}

void start(AxisFilter& filter, double z) {
  std::visit([z](auto& f) { f.start(Kinematics<1>::Vector(z)); }, filter);
}

}  // namespace ghtrack

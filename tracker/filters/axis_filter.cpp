#include "tracker/filters/axis_filter.hpp"

#include <type_traits>

#include "tracker/filters/filter_design.hpp"

namespace ghtrack {
namespace {

template <class F>
F from_guess(F filter, const std::optional<Kinematics<1>>& guess) {
  if (guess) filter.start_from(*guess);
  return filter;
}

template <int Order>
bool is_constant(const FreeGains<Order>& config) {
  return !config.schedule && !config.start_up;
}

template <int Order>
AxisFilter make(const FreeGains<Order>& config, double sigma, double dt,
                const std::optional<Kinematics<1>>& guess) {
  GainDesign design = designed(config, sigma, dt);
  if (is_constant(config)) {
    design.schedule.source = GainSource::kTable;
    design.schedule.start_up = StartUp::kNone;
  }
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
int order_of_one(const FreeGains<Order>&) {
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

bool needs_guess(const AxisFilterConfig& config) {
  return std::visit(
      [](const auto& chosen) {
        if constexpr (requires { is_constant(chosen); }) return is_constant(chosen);
        return false;
      },
      config);
}

std::optional<double> places_on_ring(const AxisFilterConfig& config) {
  const auto* const histogram = std::get_if<DiscreteBayesConfig>(&config);
  if (histogram == nullptr || !histogram->ring) return std::nullopt;
  return histogram->map.empty() ? static_cast<double>(histogram->cells)
                                : static_cast<double>(histogram->map.size());
}

bool measures_state(const AxisFilterConfig& config) {
  const auto* const histogram = std::get_if<DiscreteBayesConfig>(&config);
  return histogram == nullptr || histogram->map.empty();
}

int order_of(const AxisFilterConfig& config) {
  return std::visit([](const auto& chosen) { return order_of_one(chosen); }, config);
}

void start(AxisFilter& filter, double z) {
  std::visit([z](auto& f) { f.start(Kinematics<1>::Vector(z)); }, filter);
}

const Kinematics<1>& estimate(const AxisFilter& filter) {
  return std::visit([](const auto& f) -> const Kinematics<1>& { return f.estimate(); }, filter);
}

}  // namespace ghtrack

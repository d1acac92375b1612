#include "tracker/filters/axis_filter.hpp"

#include <algorithm>
#include <stdexcept>
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

template <Propagation Way>
AxisFilter make(const MotionFilterConfig<Way>& config, double sigma, double dt,
                const std::optional<Kinematics<1>>& guess) {
  return from_guess(MotionFilter<1>(equivalent_motion(config, sigma, dt)), guess);
}

AxisFilter make(const MultipleModelConfig& config, double sigma, double dt,
                const std::optional<Kinematics<1>>& guess) {
  return from_guess(make_bank<1>(config, sigma, dt), guess);
}

AxisFilter make(const ImmConfig& config, double sigma, double dt,
                const std::optional<Kinematics<1>>& guess) {
  return from_guess(make_bank<1>(config, sigma, dt), guess);
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

template <int Order, gain_design::Stability S>
int order_of_one(const GainFilterConfig<Order, S>&) {
  return Order;
}
template <int Order>
int order_of_one(const KalmanConfig<Order>&) {
  return Order;
}
template <Propagation Way>
int order_of_one(const MotionFilterConfig<Way>& config) {
  return std::holds_alternative<motion::NearlyConstant<2>>(config.motion) ? 2 : 1;
}
template <class Bank>
int order_of_one(const Bank& config) requires requires {
  bank_of(config);
}
{
  int order = 0;
  for (const auto& [name, filter] : bank_of(config)) {
    order = std::max(order, std::visit([](const auto& one) { return order_of_one(one); }, filter));
  }
  return order;
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

std::optional<std::string> flaw_on_one_axis(const AxisFilterConfig& config) {
  try {
    make_axis_filter(config, 1.0, 1.0, std::nullopt);
    return std::nullopt;
  } catch (const std::invalid_argument& flaw) {
    return flaw.what();
  }
}

std::vector<std::string> models_of(const AxisFilterConfig& config) {
  std::vector<std::string> names;
  std::visit(
      [&](const auto& chosen) {
        if constexpr (requires { bank_of(chosen); }) {
          for (const auto& [name, filter] : bank_of(chosen)) names.push_back(name);
        }
      },
      config);
  return names;
}

std::vector<double> model_probabilities(const AxisFilter& filter) {
  std::vector<double> weights;
  const auto add = [&](const auto& models) {
    for (const auto& model : models) weights.push_back(model.weight);
  };
  if (const auto* mixed = std::get_if<ImmFilter<1>>(&filter)) add(mixed->modes());
  if (const auto* several = std::get_if<MultipleModelFilter<1>>(&filter)) add(several->models());
  return weights;
}

int order_of(const AxisFilterConfig& config) {
  return std::visit([](const auto& chosen) { return order_of_one(chosen); }, config);
}

void start(AxisFilter& filter, const Kinematics<1>& first) {
  std::visit(
      [&](auto& f) {
        if constexpr (requires { f.start_at(first); }) {
          f.start_at(first);
        } else {
          f.start(first.position);
        }
      },
      filter);
}

const Kinematics<1>& estimate(const AxisFilter& filter) {
  return std::visit([](const auto& f) -> const Kinematics<1>& { return f.estimate(); }, filter);
}

}  // namespace ghtrack

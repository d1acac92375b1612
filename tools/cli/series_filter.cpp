#include "tools/cli/series_filter.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "scenes/schema/configuration.hpp"
#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/usage_error.hpp"
#include "tracker/filters/gains/design.hpp"

namespace ghtrack::cli {
namespace {

/// A kind that has no short options of its own, only what a scene says of it.
bool is_said_by_scenes(std::string_view name) {
  return name == EkfConfig::kind || name == UkfConfig::kind || name == ImmConfig::kind ||
         name == MultipleModelConfig::kind || name == DiscreteBayesConfig::kind;
}

/// {kind: {…}}.
bool is_configuration(std::string_view text) { return text.find_first_of("{:") != text.npos; }

double need(const FilterCommandOptions& options, const std::optional<double>& value,
            const char* name) {
  if (!value) throw UsageError(fmt::format("filter {}: {} is required", options.filter, name));
  if (!std::isfinite(*value)) throw UsageError(fmt::format("filter: {} must be finite", name));
  return *value;
}

double need_variance(const FilterCommandOptions& options, const std::optional<double>& value,
                     const char* name) {
  const double variance = need(options, value, name);
  if (variance < 0.0) throw UsageError(fmt::format("filter: {} must not be negative", name));
  return variance;
}

int need_order(const FilterCommandOptions& options) {
  const int order = options.order.value_or(1);
  if (order < 0 || order > 2) {
    throw UsageError(fmt::format("filter: --order is {}; allowed are 0, 1 and 2", order));
  }
  return order;
}

template <int Order>
using Free = gain_design::Manual<Order, gain_design::Stability::kFree>;

/// A filter with the gains of a rule; rows without times of their own are all a nominal step apart.
template <int Order, class Rule>
AxisFilterConfig with_gains(const Rule& rule, bool are_timed) {
  FreeGains<Order> config{.design = rule};
  if (!are_timed) config.irregular_time = IrregularTime::kFixedGains;
  return config;
}

template <int Order>
AxisFilterConfig fading_memory(double theta, bool are_timed) {
  return with_gains<Order>(gain_design::FadingMemory<Order>{theta}, are_timed);
}

/// One number for each axis; nothing if the text is empty.
std::optional<std::vector<double>> parse_vector(const std::string& text, const char* option,
                                                std::size_t axes) {
  if (text.empty()) return std::nullopt;
  std::vector<double> values(axes);
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const auto [next, error] = std::from_chars(at, end, values[axis]);
    const bool ends_well = axis + 1 < axes ? next != end && *next == ',' : next == end;
    if (error != std::errc{} || !ends_well || !std::isfinite(values[axis])) {
      throw UsageError(
          fmt::format("filter: {} is '{}'; needed are {} finite numbers, separated by commas",
                      option, printable(text), axes));
    }
    at = next + (axis + 1 < axes ? 1 : 0);
  }
  return values;
}

/// A configuration as in a scene, {kind: {…}}, or a bare name whose short options fill the same.
/// @return nothing for the Kalman filters of --q and --r, whose first covariance no scene can say
std::optional<AxisFilterConfig> configuration(const FilterCommandOptions& options, bool are_timed) {
  const std::string& text = options.filter;
  const auto g = [&] { return need(options, options.g, "--g"); };
  const auto h = [&] { return need(options, options.h, "--h"); };
  if (is_configuration(text)) {
    return schema::read_configuration_text<AxisFilterConfig>(text, "--filter");
  }
  if (text == FreeGains<0>::kind) return with_gains<0>(Free<0>{.g = g()}, are_timed);
  if (text == FreeGains<1>::kind) return with_gains<1>(Free<1>{.g = g(), .h = h()}, are_timed);
  if (text == FreeGains<2>::kind) {
    return with_gains<2>(Free<2>{.g = g(), .h = h(), .k = need(options, options.k, "--k")},
                         are_timed);
  }
  if (text == gain_design::BenedictBordner<1>::kind) {
    return with_gains<1>(gain_design::BenedictBordner<1>{g()}, are_timed);
  }
  if (text == gain_design::FadingMemory<1>::kind) {
    const double theta = need(options, options.theta, "--theta");
    const int order = need_order(options);
    return order == 0   ? fading_memory<0>(theta, are_timed)
           : order == 1 ? fading_memory<1>(theta, are_timed)
                        : fading_memory<2>(theta, are_timed);
  }
  if (text == LeastSquaresConfig::kind) return LeastSquaresConfig{need_order(options)};
  if (text == ScalarKalmanConfig::kind) {
    const bool has_guess = !options.x0.empty();
    return ScalarKalmanConfig{.p0 = has_guess ? need_variance(options, options.p0, "--p0") : 0.0,
                              .q = need_variance(options, options.q, "--q"),
                              .r = need_variance(options, options.r, "--r"),
                              .u = options.u.value_or(0.0)};
  }
  if (text == KalmanCvConfig::kind || text == KalmanCaConfig::kind) return std::nullopt;
  if (is_said_by_scenes(text)) {
    return schema::read_configuration_text<AxisFilterConfig>(fmt::format("{{{}: {{}}}}", text),
                                                             "--filter");
  }
  throw UsageError(fmt::format("filter: unknown filter '{}'{}", printable(text),
                               hint(text, "filters", filter_names())));
}

/// The textbook's Kalman filter of --q and --r, whose random acceleration is new at every step.
template <int Order>
KalmanFilter<Order, 1> kalman(const FilterCommandOptions& options, double dt,
                              const Kinematics<1>& guess, bool is_measured) {
  using Filter = KalmanFilter<Order, 1>;
  const double noise = need_variance(options, options.r, "--r");
  const double process = need_variance(options, options.q, "--q");
  const double initial = options.p0 ? need_variance(options, options.p0, "--p0") : 1.0;
  typename Filter::Covariance covariance = initial * Filter::Covariance::Identity();
  if (is_measured) covariance(0, 0) = noise;
  return Filter(
      {.sigma = std::sqrt(noise), .interval = dt, .process_intensity = std::sqrt(process)}, guess,
      covariance);
}

}  // namespace

std::vector<std::string_view> filter_names() {
  auto names = []<class... C>(std::type_identity<std::variant<C...>>) {
    return std::vector<std::string_view>{C::kind...};
  }(std::type_identity<AxisFilterConfig>{});
  names.insert(names.end(),
               {gain_design::FadingMemory<1>::kind, gain_design::BenedictBordner<1>::kind});
  return names;
}

std::vector<std::string_view> unused_options(const FilterCommandOptions& options) {
  const std::string& filter = options.filter;
  const bool is_kalman = filter == KalmanCvConfig::kind || filter == KalmanCaConfig::kind;
  const bool is_scalar = filter == ScalarKalmanConfig::kind;
  const bool weighs = is_configuration(filter) ||
                      (is_said_by_scenes(filter) && filter != DiscreteBayesConfig::kind);
  const bool has_g = filter == FreeGains<0>::kind || filter == FreeGains<1>::kind ||
                     filter == FreeGains<2>::kind ||
                     filter == gain_design::BenedictBordner<1>::kind;
  const bool has_h = filter == FreeGains<1>::kind || filter == FreeGains<2>::kind;
  const bool fades = filter == gain_design::FadingMemory<1>::kind;
  struct Option {
    std::string_view name;
    bool is_given, is_used;
  };
  std::vector<std::string_view> unused;
  for (const Option& option :
       {Option{"--g", options.g.has_value(), has_g},
        {"--h", options.h.has_value(), has_h},
        {"--k", options.k.has_value(), filter == FreeGains<2>::kind},
        {"--theta", options.theta.has_value(), fades},
        {"--order", options.order.has_value(), fades || filter == LeastSquaresConfig::kind},
        {"--q", options.q.has_value(), is_kalman || is_scalar},
        {"--r", options.r.has_value(), is_kalman || is_scalar || weighs},
        {options.x0.empty() ? "--p0 without --x0" : "--p0", options.p0.has_value(),
         is_kalman || (is_scalar && !options.x0.empty())},
        {"--u", options.u.has_value(), is_scalar}}) {
    if (option.is_given && !option.is_used) unused.push_back(option.name);
  }
  return unused;
}

FilterPlan::FilterPlan(const FilterCommandOptions& options, std::size_t axes, bool are_timed)
    : guess(axes) {
  if (options.gamma) {
    throw UsageError(fmt::format("filter {}: a bare gamma {}", options.filter, kGammaIsAmbiguous));
  }
  config = configuration(options, are_timed);
  order = config ? order_of(*config) : options.filter == KalmanCaConfig::kind ? 2 : 1;
  if (config) models = models_of(*config);
  const auto x0 = parse_vector(options.x0, "--x0", axes);
  const auto dx0 = parse_vector(options.dx0, "--dx0", axes);
  const auto ddx0 = parse_vector(options.ddx0, "--ddx0", axes);
  has_guess = x0.has_value();
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if (x0) guess[axis].position[0] = (*x0)[axis];
    if (dx0) guess[axis].velocity[0] = (*dx0)[axis];
    if (ddx0) guess[axis].acceleration[0] = (*ddx0)[axis];
  }
}

AxisFilters::AxisFilters(const FilterCommandOptions& options, const FilterPlan& plan, double dt)
    : options_(options), plan_(plan), dt_(dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    throw UsageError(fmt::format("filter: --dt is {}; it must be positive", dt));
  }
  try {
    for (std::size_t axis = 0; axis < plan.guess.size(); ++axis) {
      AxisFilter filter = make(axis, std::nullopt);
      if (const auto* gains = std::get_if<GainFilter<1>>(&filter)) gains_ = gains->steady_gains();
      if (plan.has_guess) axes_.push_back(std::move(filter));
    }
  } catch (const UsageError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("filter {}: {}", printable(options.filter), error.what()));
  }
}

AxisFilter AxisFilters::make(std::size_t axis, const std::optional<double>& first) const {
  Kinematics<1> guess = plan_.guess[axis];
  if (first) guess.position[0] = *first;
  if (!plan_.config) {
    return options_.filter == KalmanCaConfig::kind
               ? AxisFilter(kalman<2>(options_, dt_, guess, first.has_value()))
               : AxisFilter(kalman<1>(options_, dt_, guess, first.has_value()));
  }
  const double sigma = options_.r ? std::sqrt(need_variance(options_, options_.r, "--r")) : 1.0;
  if (!first) return make_axis_filter(*plan_.config, sigma, dt_, guess);
  AxisFilter filter = make_axis_filter(*plan_.config, sigma, dt_, std::nullopt);
  ghtrack::start(filter, guess);
  return filter;
}

void AxisFilters::start(const MeasuredRow& row) {
  for (std::size_t axis = 0; axis < plan_.guess.size(); ++axis) {
    axes_.push_back(make(axis, (*row.z)[static_cast<Eigen::Index>(axis)]));
  }
}

bool AxisFilters::predict(double dt) {
  bool predicted = true;
  for (AxisFilter& axis : axes_) {
    predicted = std::visit([dt](auto& filter) { return filter.predict(dt); }, axis) && predicted;
  }
  return predicted;
}

bool AxisFilters::update(const AxisVector& z, const MeasuredRow& row) {
  bool used = true;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Kinematics<1>::Vector measured(z[static_cast<Eigen::Index>(i)]);
    if (!row.g && !row.h && !row.k) {
      used = std::visit([&](auto& filter) { return filter.update(measured); }, axes_[i]) && used;
      continue;
    }
    auto* const filter = std::get_if<GainFilter<1>>(&axes_[i]);
    if (filter == nullptr) {
      throw UsageError("filter: columns g, h and k are for filters with constant gains");
    }
    Gains gains = filter->steady_gains();
    gains.g = row.g.value_or(gains.g);
    gains.h = row.h.value_or(gains.h);
    gains.k = row.k.value_or(gains.k);
    used = filter->update(measured, gains) && used;
  }
  return used;
}

AxisVector AxisFilters::residual() const {
  AxisVector residual(static_cast<Eigen::Index>(axes_.size()));
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    residual[static_cast<Eigen::Index>(i)] =
        std::visit([](const auto& filter) { return filter.residual().value()[0]; }, axes_[i]);
  }
  return residual;
}

Refusals AxisFilters::refusals() const {
  if (axes_.empty()) return {};
  return std::visit([](const auto& filter) { return filter.refusals(); }, axes_.front());
}

}  // namespace ghtrack::cli

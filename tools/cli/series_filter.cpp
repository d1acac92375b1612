#include "tools/cli/series_filter.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/usage_error.hpp"
#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack::cli {
namespace {

constexpr std::array<std::string_view, 9> kFilters = {
    "gh",        "ghk",       "order0",   "least-squares", "fading-memory", "benedict-bordner",
    "kalman-cv", "kalman-ca", "kalman-1d"};

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

/// Constant gains, for those filters that have them.
std::optional<Gains> constant_gains(const FilterCommandOptions& options) {
  const std::string& filter = options.filter;
  if (options.gamma) {
    throw UsageError(fmt::format("filter {}: a bare gamma {}", filter, kGammaIsAmbiguous));
  }
  try {
    if (filter == "order0") return Gains::of_g(need(options, options.g, "--g"));
    if (filter == "gh") {
      return Gains::of_gh(need(options, options.g, "--g"), need(options, options.h, "--h"));
    }
    if (filter == "ghk") {
      return Gains::of_ghk(need(options, options.g, "--g"), need(options, options.h, "--h"),
                           need(options, options.k, "--k"));
    }
    if (filter == "benedict-bordner") {
      return benedict_bordner_gains(need(options, options.g, "--g"));
    }
    if (filter == "fading-memory") {
      return fading_memory_gains(need_order(options), need(options, options.theta, "--theta"));
    }
  } catch (const UsageError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("filter {}: {}", filter, error.what()));
  }
  return std::nullopt;
}

template <int Order, int D>
KalmanFilter<Order, D> kalman(const FilterCommandOptions& options, const Kinematics<D>& guess) {
  using Filter = KalmanFilter<Order, D>;
  const double noise = need_variance(options, options.r, "--r");
  const double process = need_variance(options, options.q, "--q");
  const double initial = options.p0 ? need_variance(options, options.p0, "--p0") : 1.0;
  return Filter(
      {.sigma = std::sqrt(noise), .interval = options.dt, .process_intensity = std::sqrt(process)},
      guess, typename Filter::Covariance(initial * Filter::Covariance::Identity()));
}

int order_of(const FilterCommandOptions& options) {
  if (const auto gains = constant_gains(options)) return gains->order;
  if (options.filter == "least-squares") return need_order(options);
  if (options.filter == "kalman-ca") return 2;
  return options.filter == "kalman-1d" ? 0 : 1;
}

}  // namespace

template <int D>
RandomWalkFilter<D>::RandomWalkFilter(const Vector& guess, double variance,
                                      const Transition& transition, double noise)
    : variance_(variance), transition_(transition), noise_(noise) {
  estimate_.position = guess;
}

template <int D>
bool RandomWalkFilter<D>::predict(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    ++refusals_.times;
    return false;
  }
  for (int axis = 0; axis < D; ++axis) {
    estimate_.position[axis] = predicted({estimate_.position[axis], variance_}, transition_).mean;
  }
  variance_ = predicted({0.0, variance_}, transition_).variance;
  return true;
}

template <int D>
bool RandomWalkFilter<D>::update(const Vector& z) {
  if (!z.allFinite()) {
    ++refusals_.measurements;
    return false;
  }
  Gaussian posterior;
  for (int axis = 0; axis < D; ++axis) {
    posterior = updated({estimate_.position[axis], variance_}, z[axis], noise_).posterior;
    estimate_.position[axis] = posterior.mean;
  }
  variance_ = posterior.variance;
  return true;
}

template <int D>
SeriesFilterEngine<D>::SeriesFilterEngine(const FilterCommandOptions& options,
                                          const Kinematics<D>& guess)
    : filter_(make(options, guess)), order_(order_of(options)) {}

template <int D>
typename SeriesFilterEngine<D>::Any SeriesFilterEngine<D>::make(const FilterCommandOptions& options,
                                                                const Kinematics<D>& guess) {
  if (!(options.dt > 0.0) || !std::isfinite(options.dt)) {
    throw UsageError(fmt::format("filter: --dt is {}; it must be positive", options.dt));
  }
  if (const auto gains = constant_gains(options)) return GainFilter<D>(*gains, options.dt, guess);
  if (options.filter == "least-squares") {
    return LeastSquaresFilter<D>(need_order(options), options.dt, 1.0, guess);
  }
  if (options.filter == "kalman-cv") return kalman<1, D>(options, guess);
  if (options.filter == "kalman-ca") return kalman<2, D>(options, guess);
  if (options.filter == "kalman-1d") {
    const Transition transition{.control = options.u.value_or(0.0),
                                .process_variance = need_variance(options, options.q, "--q")};
    return RandomWalkFilter<D>(guess.position, need_variance(options, options.p0, "--p0"),
                               transition, need_variance(options, options.r, "--r"));
  }
  throw UsageError(fmt::format("filter: unknown filter '{}'{}", printable(options.filter),
                               hint(options.filter, "filters", kFilters)));
}

template <int D>
bool SeriesFilterEngine<D>::predict(double dt) {
  return std::visit([&](auto& filter) { return filter.predict(dt); }, filter_);
}

template <int D>
bool SeriesFilterEngine<D>::update(const Vector& z, std::optional<double> g,
                                   std::optional<double> h, std::optional<double> k) {
  auto* gain_filter = std::get_if<GainFilter<D>>(&filter_);
  if (!g && !h && !k) {
    return std::visit([&](auto& filter) { return filter.update(z); }, filter_);
  }
  if (gain_filter == nullptr) {
    throw UsageError("filter: columns g, h and k are for filters with constant gains");
  }
  Gains gains = gain_filter->steady_gains();
  gains.g = g.value_or(gains.g);
  gains.h = h.value_or(gains.h);
  gains.k = k.value_or(gains.k);
  return gain_filter->update(z, gains);
}

template <int D>
const Kinematics<D>& SeriesFilterEngine<D>::estimate() const {
  return std::visit([](const auto& filter) -> const Kinematics<D>& { return filter.estimate(); },
                    filter_);
}

template <int D>
Refusals SeriesFilterEngine<D>::refusals() const {
  return std::visit([](const auto& filter) { return Refusals(filter.refusals()); }, filter_);
}

template class SeriesFilterEngine<1>;
template class SeriesFilterEngine<2>;
template class SeriesFilterEngine<3>;

void warn_of_unstable_gains(const FilterCommandOptions& options, bool quiet) {
  const auto gains = constant_gains(options);
  const auto violated = gains ? violated_inequality(*gains) : std::nullopt;
  if (!violated || quiet) return;
  fmt::print(stderr, "ghtrack: warning: these gains are unstable: {} does not hold\n", *violated);
}

}  // namespace ghtrack::cli

// `ghtrack gains`: gains by rule, and what they do.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/usage_error.hpp"
#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/polynomial_memory.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack::cli {
namespace {

using nlohmann::ordered_json;

// Where the closed forms keep their digits.
constexpr double kLeastTrackingIndex = 1e-9;
constexpr double kMostTrackingIndex = 1e6;

template <class Value>
Value need(const std::optional<Value>& option, const char* name, const std::string& rule) {
  if (!option) throw UsageError(fmt::format("gains {}: {} is required", rule, name));
  return *option;
}

int order_of(const GainsCommandOptions& options, int lowest) {
  const int order = options.order.value_or(1);
  if (order < lowest || order > 2) {
    throw UsageError(
        fmt::format("gains {}: --order is {}; allowed are {} to 2", options.rule, order, lowest));
  }
  return order;
}

Gains manual(const GainsCommandOptions& options) {
  if (options.gamma) {
    throw UsageError(fmt::format("gains manual: a bare gamma {}", kGammaIsAmbiguous));
  }
  const double g = need(options.g, "--g", "manual");
  if (!options.h && !options.k) return Gains::of_g(g);
  const double h = need(options.h, "--h", "manual");
  return options.k ? Gains::of_ghk(g, h, *options.k) : Gains::of_gh(g, h);
}

double index_of(const GainsCommandOptions& options) {
  if (options.index) return *options.index;
  if (!options.process_noise || !options.noise) {
    throw UsageError(
        "gains tracking-index: give --index, or --process-noise and --noise with --dt");
  }
  const double index = tracking_index(*options.process_noise, *options.noise, options.dt);
  if (index >= kLeastTrackingIndex && index <= kMostTrackingIndex) return index;
  throw UsageError(
      fmt::format("gains tracking-index: process noise * dt^2 / noise is {:.4g}; allowed: {} to {}",
                  index, kLeastTrackingIndex, kMostTrackingIndex));
}

/// A rule, and the options that choose its gains; --dt, --sigma, --accel, --jerk and --json are for
/// all.
struct Rule {
  std::function<Gains(const GainsCommandOptions&)> gains;
  std::vector<std::string_view> options;
};

const std::map<std::string, Rule, std::less<>>& rules() {
  using Options = GainsCommandOptions;
  static const std::map<std::string, Rule, std::less<>> all = {
      {"manual", {manual, {"--g", "--h", "--k", "--gamma"}}},
      {"benedict-bordner",
       {[](const Options& o) { return benedict_bordner_gains(need(o.g, "--g", o.rule)); },
        {"--g"}}},
      {"critical-damping",
       {[](const Options& o) {
          return fading_memory_gains(order_of(o, 1), need(o.theta, "--theta", o.rule));
        },
        {"--theta", "--order"}}},
      {"fading-memory",
       {[](const Options& o) {
          return fading_memory_gains(order_of(o, 0), need(o.theta, "--theta", o.rule));
        },
        {"--theta", "--order"}}},
      {"least-squares",
       {[](const Options& o) {
          return growing_memory_gains(order_of(o, 0), need(o.n, "--n", o.rule));
        },
        {"--n", "--order"}}},
      {"tracking-index",
       {[](const Options& o) { return tracking_index_gains(order_of(o, 0), index_of(o)); },
        {"--index", "--process-noise", "--noise", "--order"}}},
      {"maximum-acceleration",
       {[](const Options& o) {
          return maximum_acceleration_gains(std::abs(o.accel) * o.dt * o.dt / o.sigma);
        },
        {}}},
      {"polge-bhagavan",
       {[](const Options& o) { return polge_bhagavan_gains(need(o.g, "--g", o.rule)); }, {"--g"}}},
  };
  return all;
}

/// An option that the rule makes nothing of is a misunderstanding: `benedict-bordner --order 2`.
void refuse_unused_options(const GainsCommandOptions& options, const Rule& rule) {
  const std::pair<std::string_view, bool> given[] = {
      {"--g", options.g.has_value()},
      {"--h", options.h.has_value()},
      {"--k", options.k.has_value()},
      {"--gamma", options.gamma.has_value()},
      {"--theta", options.theta.has_value()},
      {"--n", options.n.has_value()},
      {"--order", options.order.has_value()},
      {"--index", options.index.has_value()},
      {"--noise", options.noise.has_value()},
      {"--process-noise", options.process_noise.has_value()}};
  for (const auto& [name, is_given] : given) {
    const bool used =
        std::find(rule.options.begin(), rule.options.end(), name) != rule.options.end();
    if (!is_given || used) continue;
    const std::string wanted = rule.options.empty()
                                   ? "--accel, --sigma, --dt"
                                   : fmt::format("{}", fmt::join(rule.options, ", "));
    throw UsageError(fmt::format("gains {}: {} chooses nothing here; this rule takes {}",
                                 options.rule, name, wanted));
  }
}

Gains gains_by_rule(const GainsCommandOptions& options) {
  const auto rule = rules().find(options.rule);
  if (rule == rules().end()) {
    std::vector<std::string_view> names;
    for (const auto& [name, unused] : rules()) names.push_back(name);
    throw UsageError(fmt::format("gains: unknown rule '{}'{}", printable(options.rule),
                                 hint(options.rule, "rules", names)));
  }
  refuse_unused_options(options, rule->second);
  try {
    return rule->second.gains(options);
  } catch (const UsageError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("gains {}: {}", options.rule, error.what()));
  }
}

double next_derivative(const GainsCommandOptions& options, int order) {
  return order == 2 ? options.jerk : order == 1 ? options.accel : 0.0;
}

/// What is not finite is not known.
ordered_json known(double value) { return std::isfinite(value) ? ordered_json(value) : nullptr; }

/// Components that the order does not have are null.
ordered_json by_component(int order, double x, double dx, double ddx) {
  ordered_json json = {{"x", known(x)}};
  json["dx"] = order >= 1 ? known(dx) : ordered_json();
  json["ddx"] = order >= 2 ? known(ddx) : ordered_json();
  return json;
}

/// Of growing-memory gains the variances after n measurements count, not those that these gains
/// would have if they were held for ever. n points determine a polynomial of a lower order only.
/// Zarchan & Musoff, Fundamentals of Kalman Filtering, chapter 3.
VarianceReduction variances_of(const Gains& gains, const GainsCommandOptions& options) {
  if (options.rule != "least-squares") return variance_reduction(gains, options.dt);
  const auto sigma = growing_memory_sigma(gains.order, *options.n, 1.0, options.dt);
  const double n = *options.n;
  VarianceReduction variances;
  variances.x = sigma[0] * sigma[0];
  variances.dx = sigma[1] * sigma[1];
  variances.ddx = sigma[2] * sigma[2];
  variances.prediction = gains.order == 0 ? 1.0 / n
                         : gains.order == 1
                             ? 2.0 * (2.0 * n + 1.0) / (n * (n - 1.0))
                             : 3.0 * (3.0 * n * n + 3.0 * n + 2.0) / (n * (n - 1.0) * (n - 2.0));
  return variances;
}

ordered_json analysis_of(const Gains& gains, const GainsCommandOptions& options) {
  const auto violated = violated_inequality(gains);
  const int order = gains.order;
  ordered_json json;
  json["g"] = gains.g;
  json["h"] = gains.h;
  json["k"] = gains.k;
  json["order"] = order;
  json["stable"] = !violated;
  json["damping"] = to_string(damping(gains));
  json["damping_ratio"] = damping_ratio(gains);
  json["poles"] = ordered_json::array();
  for (const std::complex<double>& pole : poles(gains)) {
    json["poles"].push_back({pole.real(), pole.imag()});
  }
  json["violated"] = violated ? ordered_json(*violated) : ordered_json();
  ordered_json none = {{"x", nullptr}, {"dx", nullptr}, {"ddx", nullptr}, {"prediction", nullptr}};
  if (violated) {
    json["vrf"] = none;
    json["lag"] = {{"prediction", nullptr}, {"x", nullptr}, {"dx", nullptr}, {"ddx", nullptr}};
    json["settling_updates"] = nullptr;
    json["transient_energy"] = nullptr;
    return json;
  }
  const VarianceReduction vrf = variances_of(gains, options);
  const Lag lag = steady_lag(gains, options.dt, next_derivative(options, order));
  const TransientEnergy energy = transient_energy(gains, options.dt);
  json["vrf"] = by_component(order, vrf.x, vrf.dx, vrf.ddx);
  json["vrf"]["prediction"] = known(vrf.prediction);
  json["lag"] = {{"prediction", lag.prediction}};
  json["lag"].update(by_component(order, lag.x, lag.dx, lag.ddx));
  json["settling_updates"] = settling_updates(gains);
  json["transient_energy"] = {
      {"position", energy.position},
      {"velocity", order >= 1 ? ordered_json(energy.velocity) : nullptr},
      {"acceleration", order >= 2 ? ordered_json(energy.acceleration) : nullptr}};
  return json;
}

/// In words that agree with the ratio as it is printed.
std::string damping_text(const Gains& gains) {
  const Damping kind = damping(gains);
  if (kind == Damping::kAlternating) return "alternating";
  if (gains.order == 0) return "without overshoot";
  const std::string ratio = fmt::format("{:.4g}", damping_ratio(gains));
  const bool is_critical = ratio == "1" || kind == Damping::kCritical;
  return fmt::format("{} (damping ratio {})",
                     is_critical ? "critically damped" : fmt::format("{}-damped", to_string(kind)),
                     ratio);
}

std::string as_text(const Gains& gains, const GainsCommandOptions& options) {
  std::string text = fmt::format("g = {}\n", gains.g);
  if (gains.order >= 1) text += fmt::format("h = {}\n", gains.h);
  if (gains.order >= 2) text += fmt::format("k = {}   (a += 2 k r / dt^2)\n", gains.k);
  if (const auto violated = violated_inequality(gains)) {
    return text + fmt::format("unstable: {} does not hold\n", *violated);
  }
  const VarianceReduction vrf = variances_of(gains, options);
  const Lag lag = steady_lag(gains, options.dt, next_derivative(options, gains.order));
  text += fmt::format("stable, {}, settles to 2 % in {:.3g} updates\n", damping_text(gains),
                      settling_updates(gains));
  text += fmt::format("poles:");
  for (const std::complex<double>& pole : poles(gains)) {
    text += pole.imag() == 0.0 ? fmt::format("  {:.6g}", pole.real())
                               : fmt::format("  {:.6g}{:+.6g}i", pole.real(), pole.imag());
  }
  const double sigma = options.sigma;
  text += fmt::format("\n{:<12}{:>16}{:>16}{:>16}\n", "", "noise variance", "1-sigma error", "lag");
  const auto row = [&](const char* name, double variance, double behind) {
    text += fmt::format("{:<12}{:>16.6g}{:>16.6g}{:>16.6g}\n", name, variance,
                        sigma * std::sqrt(variance), behind);
  };
  row("prediction", vrf.prediction, lag.prediction);
  row("x", vrf.x, lag.x);
  if (gains.order >= 1) row("dx", vrf.dx, lag.dx);
  if (gains.order >= 2) row("ddx", vrf.ddx, lag.ddx);
  if (options.rule == "least-squares") {
    text += fmt::format("variances: after {} measurements; lag: if these gains were kept\n",
                        *options.n);
  }
  return text;
}

}  // namespace

int gains(const GainsCommandOptions& options, const Manners&) {
  if (!(options.dt > 0.0) || !std::isfinite(options.dt)) {
    throw UsageError(fmt::format("gains: --dt is {}; it must be positive", options.dt));
  }
  const Gains result = gains_by_rule(options);
  print(options.json ? analysis_of(result, options).dump() + "\n" : as_text(result, options));
  return 0;
}

}  // namespace ghtrack::cli

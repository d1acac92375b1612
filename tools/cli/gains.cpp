// `ghtrack gains`: gains by rule, and what they do.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/usage_error.hpp"
#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack::cli {
namespace {

using nlohmann::ordered_json;

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
  return tracking_index(*options.process_noise, *options.noise, options.dt);
}

using Rule = std::function<Gains(const GainsCommandOptions&)>;

const std::map<std::string, Rule, std::less<>>& rules() {
  using Options = GainsCommandOptions;
  static const std::map<std::string, Rule, std::less<>> all = {
      {"manual", manual},
      {"benedict-bordner",
       [](const Options& o) { return benedict_bordner_gains(need(o.g, "--g", o.rule)); }},
      {"critical-damping",
       [](const Options& o) {
         return fading_memory_gains(order_of(o, 1), need(o.theta, "--theta", o.rule));
       }},
      {"fading-memory",
       [](const Options& o) {
         return fading_memory_gains(order_of(o, 0), need(o.theta, "--theta", o.rule));
       }},
      {"least-squares",
       [](const Options& o) {
         return growing_memory_gains(order_of(o, 0), need(o.n, "--n", o.rule));
       }},
      {"tracking-index",
       [](const Options& o) { return tracking_index_gains(order_of(o, 0), index_of(o)); }},
      {"maximum-acceleration",
       [](const Options& o) {
         return maximum_acceleration_gains(std::abs(o.accel) * o.dt * o.dt / o.sigma);
       }},
      {"polge-bhagavan",
       [](const Options& o) { return polge_bhagavan_gains(need(o.g, "--g", o.rule)); }},
  };
  return all;
}

Gains gains_by_rule(const GainsCommandOptions& options) {
  const auto rule = rules().find(options.rule);
  if (rule == rules().end()) {
    std::vector<std::string_view> names;
    for (const auto& [name, unused] : rules()) names.push_back(name);
    throw UsageError(fmt::format("gains: unknown rule '{}'{}", printable(options.rule),
                                 hint(options.rule, "rules", names)));
  }
  try {
    return rule->second(options);
  } catch (const UsageError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("gains {}: {}", options.rule, error.what()));
  }
}

double next_derivative(const GainsCommandOptions& options, int order) {
  return order == 2 ? options.jerk : order == 1 ? options.accel : 0.0;
}

/// Components that the order does not have are null.
ordered_json by_component(int order, double x, double dx, double ddx) {
  ordered_json json = {{"x", x}};
  json["dx"] = order >= 1 ? ordered_json(dx) : ordered_json();
  json["ddx"] = order >= 2 ? ordered_json(ddx) : ordered_json();
  return json;
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
  const VarianceReduction vrf = variance_reduction(gains, options.dt);
  const Lag lag = steady_lag(gains, options.dt, next_derivative(options, order));
  const TransientEnergy energy = transient_energy(gains, options.dt);
  json["vrf"] = by_component(order, vrf.x, vrf.dx, vrf.ddx);
  json["vrf"]["prediction"] = vrf.prediction;
  json["lag"] = {{"prediction", lag.prediction}};
  json["lag"].update(by_component(order, lag.x, lag.dx, lag.ddx));
  json["settling_updates"] = settling_updates(gains);
  json["transient_energy"] = {
      {"position", energy.position},
      {"velocity", order >= 1 ? ordered_json(energy.velocity) : nullptr},
      {"acceleration", order >= 2 ? ordered_json(energy.acceleration) : nullptr}};
  return json;
}

std::string as_text(const Gains& gains, const GainsCommandOptions& options) {
  std::string text = fmt::format("g = {}\n", gains.g);
  if (gains.order >= 1) text += fmt::format("h = {}\n", gains.h);
  if (gains.order >= 2) text += fmt::format("k = {}   (a += 2 k r / dt^2)\n", gains.k);
  if (const auto violated = violated_inequality(gains)) {
    return text + fmt::format("unstable: {} does not hold\n", *violated);
  }
  const VarianceReduction vrf = variance_reduction(gains, options.dt);
  const Lag lag = steady_lag(gains, options.dt, next_derivative(options, gains.order));
  text += fmt::format("stable, {}damped (damping ratio {:.4g}), settles to 2 % in {:.3g} updates\n",
                      damping(gains) == Damping::kAlternating
                          ? "alternating, "
                          : fmt::format("{}-", to_string(damping(gains))),
                      damping_ratio(gains), settling_updates(gains));
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

// The only file that knows NLopt.

#include "tools/experiment/gain_search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

constexpr double kLargestShare = 0.999;  // of the way to the edge of the stability region
constexpr double kHugeCost = 1e300;      // NLopt does not take +∞

/// From `low` to `high` in equal ratios.
double between(double low, double high, double parameter) {
  return low * std::pow(high / low, parameter);
}

Gains stable_gh(std::span<const double> p) {
  const double g = between(1e-3, 1.99, p[0]);
  return Gains::of_gh(g, between(1e-6, kLargestShare, p[1]) * (4.0 - 2.0 * g));
}

Gains stable_ghk(std::span<const double> p) {
  const Gains gh = stable_gh(p);
  const double most = gh.g * gh.h / (2.0 - gh.g);
  return Gains::of_ghk(gh.g, gh.h, between(1e-6, kLargestShare, p[2]) * most);
}

double g_of(double parameter) { return between(1e-3, 0.999, parameter); }

Gains benedict_bordner_gh(std::span<const double> p) { return benedict_bordner_gains(g_of(p[0])); }
Gains benedict_bordner_ghk(std::span<const double> p) {
  return third_order_benedict_bordner_gains(g_of(p[0]));
}
Gains critically_damped_gh(std::span<const double> p) {
  return fading_memory_gains(1, std::sqrt(1.0 - g_of(p[0])));
}
Gains critically_damped_ghk(std::span<const double> p) {
  return fading_memory_gains(2, std::cbrt(1.0 - g_of(p[0])));
}
Gains kalata_gh(std::span<const double> p) {
  return tracking_index_gains(1, between(1e-6, 1e2, p[0]));
}
Gains kalata_ghk(std::span<const double> p) {
  return tracking_index_gains(2, between(1e-6, 1e2, p[0]));
}

constexpr std::array<GainFamily, 6> kRules = {{
    {"benedict-bordner", 1, 1, benedict_bordner_gh},
    {"benedict-bordner", 2, 1, benedict_bordner_ghk},
    {"critical-damping", 1, 1, critically_damped_gh},
    {"critical-damping", 2, 1, critically_damped_ghk},
    {"tracking-index", 1, 1, kalata_gh},
    {"tracking-index", 2, 1, kalata_ghk},
}};

/// What NLopt minimises, and the best that it has seen.
struct Search {
  std::function<Gains(std::span<const double>)> gains_at;
  const std::function<double(const Gains&)>& cost;
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  nlopt_opt running = nullptr;
  std::exception_ptr failure = nullptr;  // of the cost; NLopt is written in C

  static double evaluate(unsigned count, const double* parameters, double* /*gradient*/,
                         void* data) {
    auto& search = *static_cast<Search*>(data);
    const std::span<const double> at(parameters, count);
    try {
      const double cost = search.cost(search.gains_at(at));
      if (cost < search.least) {
        search.least = cost;
        search.best.assign(at.begin(), at.end());
      }
      return std::isfinite(cost) ? cost : kHugeCost;
    } catch (...) {
      search.failure = std::current_exception();
      nlopt_force_stop(search.running);
      return kHugeCost;
    }
  }

  void run(nlopt_algorithm algorithm, int evaluations, double least_parameter, double most,
           double first_step, double tolerance) {
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(
        nlopt_create(algorithm, static_cast<unsigned>(best.size())), nlopt_destroy);
    nlopt_set_min_objective(optimiser.get(), evaluate, this);
    nlopt_set_lower_bounds1(optimiser.get(), least_parameter);
    nlopt_set_upper_bounds1(optimiser.get(), most);
    nlopt_set_maxeval(optimiser.get(), evaluations);
    nlopt_set_xtol_abs1(optimiser.get(), tolerance);
    if (algorithm == NLOPT_LN_SBPLX) nlopt_set_initial_step1(optimiser.get(), first_step);
    std::vector<double> parameters = best;
    double value = 0.0;
    running = optimiser.get();
    const nlopt_result result = nlopt_optimize(running, parameters.data(), &value);
    if (failure) std::rethrow_exception(failure);
    if (result == NLOPT_INVALID_ARGS || result == NLOPT_OUT_OF_MEMORY) {
      throw std::runtime_error("the optimiser failed: " +
                               std::string(nlopt_result_to_string(result)));
    }
  }
};

}  // namespace

GainFamily stable_gains(int order) {
  if (order == 1) return {"manual", 1, 2, stable_gh};
  if (order == 2) return {"manual", 2, 3, stable_ghk};
  throw std::invalid_argument("gains are searched for order 1 or 2");
}

std::optional<GainFamily> gains_of_rule(std::string_view rule, int order) {
  for (const GainFamily& family : kRules) {
    if (family.name == rule && family.order == order) return family;
  }
  return std::nullopt;
}

std::vector<std::string_view> rules_with_a_family() {
  std::vector<std::string_view> names;
  for (const GainFamily& family : kRules) {
    if (family.order == 1) names.push_back(family.name);
  }
  return names;
}

FoundGains least_cost(const GainFamily& family, const std::function<double(const Gains&)>& cost) {
  constexpr int kRough = 80;  // evaluations per parameter
  constexpr int kFine = 120;
  Search search{family.at, cost, std::vector<double>(family.parameters, 0.5)};
  const int parameters = static_cast<int>(family.parameters);
  search.run(NLOPT_GN_DIRECT_L, kRough * parameters * parameters, 0.0, 1.0, 0.05, 1e-5);
  search.run(NLOPT_LN_SBPLX, kFine * parameters, 0.0, 1.0, 0.05, 1e-5);
  return {family.at(search.best), search.least};
}

FoundNumber least_cost_of_number(double low, double high, int points, int sections,
                                 const std::function<double(double)>& cost) {
  constexpr double kGolden = 0.6180339887498949;
  const auto at = [&](double place) { return between(low, high, place / (points - 1)); };
  FoundNumber best{low, std::numeric_limits<double>::infinity()};
  double place = 0.0;
  for (int i = 0; i < points; ++i) {
    const double value = cost(at(i));
    if (!(value < best.cost)) continue;
    best = {at(i), value};
    place = i;
  }
  // Golden sections: one of the two places within is one of the next two.
  double from = place - 1.0, to = place + 1.0;
  const auto look = [&](double where) {
    const double value = cost(at(where));
    if (value < best.cost) best = {at(where), value};
    return value;
  };
  double left = to - kGolden * (to - from), right = from + kGolden * (to - from);
  double of_left = look(left), of_right = look(right);
  for (int i = 1; i < sections; ++i) {
    if (of_left < of_right) {
      to = std::exchange(right, left);
      of_right = of_left;
      left = to - kGolden * (to - from);
      of_left = look(left);
    } else {
      from = std::exchange(left, right);
      of_left = of_right;
      right = from + kGolden * (to - from);
      of_right = look(right);
    }
  }
  return best;
}

FoundGains least_cost_near(const Gains& start, const std::function<double(const Gains&)>& cost) {
  constexpr int kEvaluations = 35;    // per parameter
  constexpr double kFarthest = 40.0;  // of the logarithm of the odds
  // Shares of what stability leaves: of 2 to g, of 4 − 2g to h, of g h / (2 − g) to k.
  const auto share_of = [](double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); };
  const auto log_odds_of = [](double share) {
    const double inside = std::clamp(share, 1e-15, 1.0 - 1e-12);
    return std::log(inside / (1.0 - inside));
  };
  const auto gains_at = [&](std::span<const double> p) {
    const double g = 2.0 * share_of(p[0]);
    const double h = (4.0 - 2.0 * g) * share_of(p[1]);
    if (start.order == 1) return Gains::of_gh(g, h);
    return Gains::of_ghk(g, h, g * h / (2.0 - g) * share_of(p[2]));
  };
  std::vector<double> from = {log_odds_of(start.g / 2.0),
                              log_odds_of(start.h / (4.0 - 2.0 * start.g))};
  if (start.order == 2) {
    from.push_back(log_odds_of(start.k * (2.0 - start.g) / (start.g * start.h)));
  }
  Search search{gains_at, cost, std::move(from)};
  search.run(NLOPT_LN_SBPLX, kEvaluations * static_cast<int>(search.best.size()), -kFarthest,
             kFarthest, 0.5, 1e-3);
  return {gains_at(search.best), search.least};
}

}  // namespace ghtrack

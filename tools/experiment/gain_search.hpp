#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tracker/filters/gains/gains.hpp"

namespace ghtrack {

/// Stable gains as a function of a few parameters, each from 0 to 1.
struct GainFamily {
  std::string_view name;  // of the rule; "manual" for all stable gains
  int order = 1;
  unsigned parameters = 1;
  Gains (*at)(std::span<const double> parameters) = nullptr;
};

/// All stable g-h (order 1) or g-h-k (order 2) gains, log-spaced inside the stability region:
/// 0.001 ≤ g < 2, and shares of what is left to h and to k.
GainFamily stable_gains(int order);

/// The gains of one rule: benedict-bordner, critical-damping or tracking-index. Nothing for another
/// name.
std::optional<GainFamily> gains_of_rule(std::string_view rule, int order);
std::vector<std::string_view> rules_with_a_family();

struct FoundGains {
  Gains gains;
  double cost = 0.0;
};

/// The member of a family with the least cost: DIRECT-L (Gablonsky & Kelley 2001) for a rough
/// place, Subplex (Rowan 1990) from there; both without derivatives or random numbers.
/// @param cost  finite, or +∞
FoundGains least_cost(const GainFamily& family, const std::function<double(const Gains&)>& cost);

/// A number and its cost.
struct FoundNumber {
  double at = 0.0;
  double cost = 0.0;
};

/// The least cost of a positive number: the best of so many, from `low` to `high` in equal ratios,
/// refined by so many golden sections between its neighbours.
FoundNumber least_cost_of_number(double low, double high, int points, int sections,
                                 const std::function<double(double)>& cost);

/// The least cost in the whole stable region of g-h or g-h-k gains, by Subplex from a start in it.
FoundGains least_cost_near(const Gains& start, const std::function<double(const Gains&)>& cost);

}  // namespace ghtrack

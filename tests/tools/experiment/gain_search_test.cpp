#include "tools/experiment/gain_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

// Derived: the minimiser of prediction noise + μ · energy of a velocity step is Benedict–Bordner's
// pair h = g² / (2 − g) with μ = h² / (1 − g) (Benedict & Bordner 1962).
TEST(LeastCost, FindsBenedictBordner) {
  const Gains optimum = benedict_bordner_gains(0.4);
  const double weight = optimum.h * optimum.h / (1.0 - optimum.g);
  const FoundGains found = least_cost(stable_gains(1), [&](const Gains& gains) {
    return variance_reduction(gains, 1.0).prediction +
           weight * transient_energy(gains, 1.0).velocity;
  });
  EXPECT_NEAR(found.gains.g, optimum.g, 2e-3);
  EXPECT_NEAR(found.gains.h, optimum.h, 2e-3);
}

// Derived: with the energy of an acceleration step it is Kalata's triple (Simpson 1963, Neal 1967),
// with μ = 4 k² / (1 − g), four times as the gain on the acceleration is 2 k.
TEST(LeastCost, FindsItsThirdOrderCounterpart) {
  const Gains optimum = third_order_benedict_bordner_gains(0.5);
  const double weight = 4.0 * optimum.k * optimum.k / (1.0 - optimum.g);
  const auto cost = [&](const Gains& gains) {
    return variance_reduction(gains, 1.0).prediction +
           weight * transient_energy(gains, 1.0).acceleration;
  };
  const FoundGains found = least_cost(stable_gains(2), cost);
  EXPECT_LE(found.cost, cost(optimum) * (1.0 + 1e-4));
  EXPECT_NEAR(found.gains.g, optimum.g, 0.02);
}

// Property: families hold stable gains of their order only, from end to end.
TEST(GainFamilies, HoldStableGainsOnly) {
  for (const int order : {1, 2}) {
    std::vector<GainFamily> families = {stable_gains(order)};
    for (const std::string_view rule : rules_with_a_family()) {
      families.push_back(*gains_of_rule(rule, order));
    }
    for (const GainFamily& family : families) {
      for (int i = 0; i <= 10; ++i) {
        for (int j = 0; j <= 10; ++j) {
          const std::vector<double> at = {0.1 * i, 0.1 * j, 0.1 * ((i + j) % 11)};
          const Gains gains = family.at({at.data(), family.parameters});
          EXPECT_EQ(gains.order, order) << family.name;
          EXPECT_TRUE(is_stable(gains)) << family.name << " " << gains.g << " " << gains.h;
        }
      }
    }
  }
  EXPECT_FALSE(gains_of_rule("kalman", 1));
  EXPECT_THROW(stable_gains(0), std::invalid_argument);
}

// Property: costs that are not finite are avoided, not fatal.
TEST(LeastCost, AvoidsInfiniteCosts) {
  const FoundGains found = least_cost(stable_gains(1), [](const Gains& gains) {
    return gains.g > 0.5 ? std::abs(gains.g - 0.8) : std::numeric_limits<double>::infinity();
  });
  EXPECT_NEAR(found.gains.g, 0.8, 1e-3);
}

// Property: what the cost throws ends the search and is passed on, through a library written in C.
TEST(LeastCost, PassesOnWhatTheCostThrows) {
  int evaluations = 0;
  const auto cost = [&](const Gains& gains) {
    if (++evaluations == 9) throw std::runtime_error("enough");
    return gains.g;
  };
  EXPECT_THROW(least_cost(stable_gains(1), cost), std::runtime_error);
  EXPECT_EQ(evaluations, 9);
}

}  // namespace
}  // namespace ghtrack

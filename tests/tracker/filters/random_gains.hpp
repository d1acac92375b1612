#pragma once

#include <cmath>
#include <random>

#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/gains.hpp"

namespace ghtrack::testing {

/// Gains from a box around the stable region of their order.
inline Gains random_gains(int order, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> g(-0.2, 2.2);
  std::uniform_real_distribution<double> h(-0.4, 4.4);
  std::uniform_real_distribution<double> k(-0.2, 2.0);
  Gains gains{.order = order};
  gains.g = g(engine);
  if (order >= 1) gains.h = h(engine);
  if (order >= 2) gains.k = k(engine);
  return gains;
}

/// Stable gains whose transients shrink at least by `radius` per update.
inline Gains random_stable_gains(int order, double radius, std::mt19937_64& engine) {
  while (true) {
    const Gains gains = random_gains(order, engine);
    if (is_stable(gains) && std::abs(poles(gains).front()) < radius) return gains;
  }
}

}  // namespace ghtrack::testing

#pragma once

#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {

/// x^p for x ≥ 0 (p = 2: any x) and p > 0, with the same bits everywhere; exactly rounded for p =
/// 1, 2 and 1/2.
inline double power(double x, double p) {
  if (p == 1.0) return x;
  if (p == 2.0) return x * x;
  if (p == 0.5) return std::sqrt(x);
  return x > 0.0 ? portable::pow(x, p) : 0.0;
}

}  // namespace ghtrack

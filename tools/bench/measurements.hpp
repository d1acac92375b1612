#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace ghtrack::bench {

inline constexpr double kStep = 0.1;  // [s]

/// Positions that somebody measured, a few hundred metres apart.
template <class Real>
std::vector<Real> measurements(std::size_t n) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<Real> uniform(-100, 100);
  std::vector<Real> z(n);
  for (Real& value : z) value = uniform(engine);
  return z;
}

}  // namespace ghtrack::bench

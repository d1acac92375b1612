#pragma once

#include <stdexcept>

namespace ghtrack {

/// 0 for position, 1 for position and velocity, 2 with acceleration; anything else throws
/// std::invalid_argument.
inline void require_order(int order) {
  if (order < 0 || order > 2) throw std::invalid_argument("order must be 0, 1 or 2");
}

}  // namespace ghtrack

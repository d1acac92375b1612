#pragma once

#include <cmath>
#include <string>

namespace ghtrack::view {

/// Something that can be turned while watching.
struct Knob {
  std::string name;
  double low = 0.0;
  double high = 1.0;
  double value = 0.0;
  bool is_finer_near_zero = false;  // for gains: a square law

  /// Where the knob stands between its ends, and the value at such a place.
  double place() const {
    const double share = (value - low) / (high - low);
    return is_finer_near_zero ? std::sqrt(share) : share;
  }
  double value_at(double place) const {
    return low + (high - low) * (is_finer_near_zero ? place * place : place);
  }
};

}  // namespace ghtrack::view

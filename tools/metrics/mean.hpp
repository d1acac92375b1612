#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace ghtrack {

/// A mean, each value weighed by how many it stands for. Of squared errors its root is an RMSE.
class Mean {
 public:
  void add(double value, double weight = 1.0) {
    sum_ += weight * value;
    weight_ += weight;
  }
  Mean& operator+=(const Mean& other) {
    sum_ += other.sum_;
    weight_ += other.weight_;
    return *this;
  }

  double weight() const { return weight_; }

  /// Absent without any weight.
  std::optional<double> value() const {
    if (!(weight_ > 0.0)) return std::nullopt;
    return sum_ / weight_;
  }
  std::optional<double> root() const {
    if (!(weight_ > 0.0)) return std::nullopt;
    return std::sqrt(sum_ / weight_);
  }

 private:
  double sum_ = 0.0;
  double weight_ = 0.0;
};

/// A value that did not occur, in lists of plain numbers.
inline constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

inline double or_nan(const std::optional<double>& value) { return value.value_or(kNothing); }

}  // namespace ghtrack

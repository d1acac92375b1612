#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "tools/metrics/quantiles.hpp"

namespace ghtrack {

/// The mean of a series whose neighbours resemble each other, with an honest confidence interval.
/// The series is cut into 10 to 19 batches of equal length; the means of long batches are nearly
/// independent, so their scatter, with Student's t, gives the interval (batch means, Schmeiser
/// 1982). When the 20th batch is full, neighbours are merged: memory is constant.
class BatchMeans {
 public:
  void add(double value);

  std::int64_t count() const { return count_; }

  /// Mean of all values; requires count() > 0.
  double mean() const { return sum_ / static_cast<double>(count_); }

  /// 95 % confidence interval of the mean; absent with fewer than two full batches.
  std::optional<Interval> confidence95() const;

  /// How many independent values would give the mean the same variance, given the variance of one;
  /// at most count(). Equals count() where there are too few batches to tell.
  double effective_count() const;

 private:
  static constexpr int kMostBatches = 20;

  /// Variance of the mean of one batch, estimated from the full batches.
  std::optional<double> batch_variance() const;

  std::array<double, kMostBatches> sums_{};
  int batches_ = 0;  // full ones
  std::int64_t length_ = 1;
  double open_sum_ = 0.0;  // of the batch being filled
  std::int64_t open_count_ = 0;
  double sum_ = 0.0;
  double sum_of_squares_ = 0.0;
  std::int64_t count_ = 0;
};

}  // namespace ghtrack

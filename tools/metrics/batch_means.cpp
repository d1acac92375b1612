#include "tools/metrics/batch_means.hpp"

#include <algorithm>
#include <cmath>

#include "sim/portable_math.hpp"
#include "tools/metrics/power.hpp"

namespace ghtrack {
namespace {

/// How much the variance of the mean of a first-order series exceeds that of independent values.
double inflation_of(double memory) {
  constexpr double kMost = 0.9;  // more looks the same in so few batches
  const double m = std::clamp(memory, -kMost, kMost);
  return (1.0 + m) / (1.0 - m);
}

}  // namespace

void BatchMeans::add(double value) {
  ++count_;
  sum_ += value;
  sum_of_squares_ += value * value;
  open_sum_ += value;
  if (++open_count_ < length_) return;
  sums_[batches_++] = open_sum_;
  open_sum_ = 0.0;
  open_count_ = 0;
  if (batches_ < kMostBatches) return;
  batches_ /= 2;
  length_ *= 2;
  for (int i = 0; i < batches_; ++i) sums_[i] = sums_[2 * i] + sums_[2 * i + 1];
}

std::optional<BatchMeans::Batch> BatchMeans::batch() const {
  if (batches_ < kFewestBatches) return std::nullopt;
  const auto length = static_cast<double>(length_);
  double centre = 0.0;
  for (int i = 0; i < batches_; ++i) centre += sums_[i] / length;
  centre /= batches_;
  double scatter = 0.0, changes = 0.0;
  for (int i = 0; i < batches_; ++i) {
    scatter += power(sums_[i] / length - centre, 2.0);
    if (i > 0) changes += power((sums_[i] - sums_[i - 1]) / length, 2.0);
  }
  constexpr double kRounding = 1e-12;  // of equal values
  if (!(scatter > batches_ * power(kRounding * centre, 2.0))) return Batch{};
  return Batch{scatter / (batches_ - 1), (1.0 - 0.5 * changes / scatter) / (1.0 - 4.0 / batches_)};
}

std::optional<Interval> BatchMeans::confidence95() const {
  constexpr double kFewestEffective = 5.0;
  const std::optional<Batch> known = batch();
  if (!known) return std::nullopt;
  if (!(known->variance > 0.0)) return Interval{mean(), mean()};
  const double inflation = inflation_of(std::max(0.0, known->memory + 1.0 / batches_));
  const double variance = inflation * known->variance / batches_;
  if (single_variance() < kFewestEffective * variance) return std::nullopt;
  const auto degrees = static_cast<std::int64_t>(std::max(1.0, (batches_ - 1) / inflation));
  const double factor =
      portable::exp(student_quantile(0.975, degrees) * std::sqrt(variance) / mean());
  return Interval{mean() / factor, mean() * factor};
}

double BatchMeans::effective_count() const {
  const auto count = static_cast<double>(count_);
  const std::optional<Batch> known = batch();
  const double single = single_variance();
  if (!known || !(known->variance > 0.0) || !(single > 0.0)) return count;
  const double variance = inflation_of(known->memory) * known->variance / batches_;
  return std::clamp(single / variance, 1.0, count);
}

double BatchMeans::single_variance() const {
  return sum_of_squares_ / static_cast<double>(count_) - mean() * mean();
}

}  // namespace ghtrack

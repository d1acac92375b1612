#include "tools/metrics/batch_means.hpp"

#include <algorithm>
#include <cmath>

#include "tools/metrics/power.hpp"

namespace ghtrack {

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

std::optional<double> BatchMeans::batch_variance() const {
  if (batches_ < 2) return std::nullopt;
  const auto length = static_cast<double>(length_);
  double centre = 0.0;
  for (int i = 0; i < batches_; ++i) centre += sums_[i] / length;
  centre /= batches_;
  double scatter = 0.0;
  for (int i = 0; i < batches_; ++i) scatter += power(sums_[i] / length - centre, 2.0);
  return scatter / (batches_ - 1);
}

std::optional<Interval> BatchMeans::confidence95() const {
  const std::optional<double> variance = batch_variance();
  if (!variance) return std::nullopt;
  const double half = student_quantile(0.975, batches_ - 1) * std::sqrt(*variance / batches_);
  return Interval{mean() - half, mean() + half};
}

double BatchMeans::effective_count() const {
  const auto count = static_cast<double>(count_);
  const std::optional<double> variance = batch_variance();
  const double single = sum_of_squares_ / count - mean() * mean();
  if (!variance || !(*variance > 0.0) || !(single > 0.0)) return count;
  return std::clamp(single / (*variance / batches_), 1.0, count);
}

}  // namespace ghtrack

#include "tracker/boxes/box_learning.hpp"

#include <algorithm>
#include <cmath>

namespace ghtrack {

void ConfidenceScale::add(double confidence) {
  if (!std::isfinite(confidence)) return;
  count_ += 1.0;
  const double difference = confidence - mean_;
  mean_ += difference / count_;
  squares_ += difference * (confidence - mean_);
}

double ConfidenceScale::deviation() const { return std::sqrt(squares_ / std::max(count_, 1.0)); }

double ConfidenceScale::standardised(double confidence) const {
  const double unit = deviation();
  const double distance = confidence - mean_;
  // Equal numbers may differ by rounding.
  if (!(unit > 1e-9 * std::abs(mean_)) || !std::isfinite(distance)) return 0.0;
  return std::clamp(distance / unit, -4.0, 4.0);
}

void SpeedStatistics::add(const Eigen::Vector2d& velocity_in_scales) {
  constexpr double kMemory = 1000.0;
  if (count_ >= kMemory) sum_ *= (kMemory - 1.0) / count_, count_ = kMemory - 1.0;
  count_ += 1.0;
  sum_ += 0.5 * velocity_in_scales.squaredNorm();
}

double SpeedStatistics::variance(double assumed) const {
  constexpr double kAssumed = 30.0;  // worth so many observations
  return (kAssumed * assumed + sum_) / (kAssumed + count_);
}

void VarianceFactor::add(double distance) {
  constexpr double kMedian = 1.3862943611198906;  // of χ² with 2 degrees of freedom: 2 ln 2
  constexpr double kStep = 2.0;
  log_sigma_ += (distance > kMedian ? kStep : -kStep) / count_;
  log_sigma_ = std::clamp(log_sigma_, least_, greatest_);
  count_ = std::min(count_ + 1.0, 500.0);
}

double VarianceFactor::factor() const { return std::exp(2.0 * log_sigma_); }

namespace {

/// The variance of the change of a size after so many images.
double after(double images, const SizeStatistics::Variances& assumed) {
  return 2.0 * assumed.error + images * assumed.drift;
}

}  // namespace

void SizeStatistics::add_after_while(const Variances& assumed, const Eigen::Vector2d& change) {
  after_while_.add(change.squaredNorm() / (after(kWhile, assumed) * after_while_.factor()));
}

void SizeStatistics::add_after_two(const Variances& assumed, const Eigen::Vector2d& change) {
  after_two_.add(change.squaredNorm() / (after(2.0 * kWhile, assumed) * after_two_.factor()));
}

double SizeStatistics::error(const Variances& assumed) const {
  constexpr double kLeast = 0.05;  // as a share of what was seen after a while
  const double once = after(kWhile, assumed) * after_while_.factor();
  const double twice = after(2.0 * kWhile, assumed) * after_two_.factor();
  const double changed = std::clamp(twice - once, 0.0, (1.0 - kLeast) * once);
  return 0.5 * (once - changed);
}

void CoastingStatistics::add_found(int unseen, bool overlaps) {
  for (int i = 1; i <= std::min(unseen, kLongest - 1); ++i) {
    ++(overlaps ? records_[i].right : records_[i].wrong);
  }
}

void CoastingStatistics::add_lost(int unseen) {
  for (int i = 1; i < std::min(unseen, kLongest); ++i) ++records_[i].wrong;
}

bool CoastingStatistics::trusts(int unseen) const {
  return unseen > 0 && unseen < kLongest && records_[unseen].right > records_[unseen].wrong;
}

}  // namespace ghtrack

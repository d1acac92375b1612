#include "tools/experiment/lanes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace ghtrack {
namespace {

using Matrix3 = Eigen::Matrix3d;

Matrix3 matrix_of(const AxisCovariance<double>& p) {
  Matrix3 m;
  m << p.xx, p.xv, p.xa, p.xv, p.vv, p.va, p.xa, p.va, p.aa;
  return m;
}

/// G = P Fᵀ P'⁻¹ for motion during dt.
Matrix3 smoother_gain(const AxisCovariance<double>& p, const AxisCovariance<double>& predicted,
                      double dt, int order) {
  Matrix3 motion;
  motion << 1.0, dt, 0.5 * dt * dt, 0.0, 1.0, dt, 0.0, 0.0, 1.0;
  // What is not carried is known to be nothing, with any certainty.
  Matrix3 foreseen = matrix_of(predicted);
  for (int d = order + 1; d < 3; ++d) foreseen(d, d) = 1.0;
  return matrix_of(p) * motion.transpose() * foreseen.inverse();
}

}  // namespace

double square_of_difference(std::span<const double> a, std::span<const double> b) {
  std::array<double, 4> sums{};
  std::size_t i = 0;
  for (; i + sums.size() <= a.size(); i += sums.size()) {
    for (std::size_t j = 0; j < sums.size(); ++j) {
      const double difference = a[i + j] - b[i + j];
      sums[j] += difference * difference;
    }
  }
  for (; i < a.size(); ++i) sums[0] += (a[i] - b[i]) * (a[i] - b[i]);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

std::optional<Lanes> Lanes::of(const LabelledObject& object) {
  int detections = 0;
  for (const ObjectScan& scan : object.scans) {
    if (!scan.detection) continue;
    ++detections;
    const Eigen::Matrix2d& error = scan.detection->covariance;
    if (error(0, 0) != error(1, 1) || error(0, 1) != 0.0) return std::nullopt;
  }
  if (detections < kFirstDetections || !object.scans.front().detection) return std::nullopt;
  const LabelledObject* const alone = &object;
  return Lanes({&alone, 1});
}

Lanes::Lanes(std::span<const LabelledObject* const> alike) : count_(2 * alike.size()) {
  const std::vector<ObjectScan>& scans = alike.front()->scans;
  scans_.reserve(scans.size());
  truth_.reserve(count_ * scans.size());
  measured_.reserve(count_ * scans.size());
  int detections = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    Scan& scan = scans_.emplace_back();
    if (i > 0) scan.interval = scans[i].time - scans[i - 1].time;
    if (scans[i].detection) scan.variance = scans[i].detection->covariance(0, 0);
    if (scan.variance && ++detections == kFirstDetections) first_judged_ = i;
    for (const LabelledObject* object : alike) {
      for (int axis = 0; axis < 2; ++axis) {
        const ObjectScan& seen = object->scans[i];
        truth_.push_back(seen.truth.position[axis]);
        measured_.push_back(seen.detection ? seen.detection->position[axis] : 0.0);
      }
    }
  }
}

Mean Lanes::smoothed_error(const LaneMotion& motion) const {
  const int order = motion.order;
  AxisCovariance<double> p{*scans_.front().variance,
                           0.0,
                           0.0,
                           order >= 1 ? motion.spread.v * motion.spread.v : 0.0,
                           0.0,
                           order >= 2 ? motion.spread.a * motion.spread.a : 0.0};
  std::vector<double> x(measured_.size()), v(x.size()), a(x.size());  // lane by lane of each scan
  std::copy_n(measured_.begin(), count_, x.begin());
  std::vector<Matrix3> gains(scans_.size(),
                             Matrix3::Identity());  // from each scan to the one before
  double noise_interval = 0.0;
  AxisCovariance<double> noise{};
  for (std::size_t i = 1; i < scans_.size(); ++i) {
    const auto& [t, variance] = scans_[i];
    AxisCovariance<double> predicted = p;
    if (t > 0.0) {
      if (t != noise_interval) noise = motion.noise_over(noise_interval = t);
      predicted = extrapolated(p, t);
      predicted += noise;
      gains[i] = smoother_gain(p, predicted, t, order);
    }
    AxisGain<double> k{};
    if (variance) {
      const double s = predicted.xx + *variance;
      k = {predicted.xx / s, predicted.xv / s, predicted.xa / s};
    }
    p = corrected(predicted, k, variance.value_or(0.0));
    for (std::size_t j = i * count_; j < (i + 1) * count_; ++j) {
      const std::size_t before = j - count_;
      const double foreseen_x = x[before] + t * (v[before] + 0.5 * t * a[before]);
      const double residual = measured_[j] - foreseen_x;
      x[j] = foreseen_x + k.x * residual;
      v[j] = v[before] + t * a[before] + k.v * residual;
      a[j] = a[before] + k.a * residual;
    }
  }

  const std::size_t last = scans_.size() - 1;
  double sum = square_of_difference(row(x, last), row(truth_, last));
  for (std::size_t i = last; i-- > first_judged_;) {
    const Matrix3& g = gains[i + 1];
    const double t = scans_[i + 1].interval;
    for (std::size_t j = i * count_; j < (i + 1) * count_; ++j) {
      const std::size_t after = j + count_;
      const double dx = x[after] - (x[j] + t * (v[j] + 0.5 * t * a[j]));
      const double dv = v[after] - (v[j] + t * a[j]);
      const double da = a[after] - a[j];
      x[j] += g(0, 0) * dx + g(0, 1) * dv + g(0, 2) * da;
      v[j] += g(1, 0) * dx + g(1, 1) * dv + g(1, 2) * da;
      a[j] += g(2, 0) * dx + g(2, 1) * dv + g(2, 2) * da;
    }
    sum += square_of_difference(row(x, i), row(truth_, i));
  }
  const double weight =
      static_cast<double>(count_ / 2) * static_cast<double>(scans_.size() - first_judged_);
  Mean mean;
  mean.add(sum / weight, weight);
  return mean;
}

}  // namespace ghtrack

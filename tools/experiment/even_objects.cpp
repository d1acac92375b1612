#include "tools/experiment/even_objects.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "tracker/filters/batch.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kFirstScan = 2;   // that counts: see visit_judged()
constexpr double kSameInterval = 1e-9;  // relative: times are rounded

/// Seen in every scan, at even intervals, with the same error on both axes?
bool is_even(const LabelledObject& object) {
  const std::vector<ObjectScan>& scans = object.scans;
  if (scans.size() <= kFirstScan || !scans.front().detection) return false;
  const double interval = scans[1].time - scans[0].time;
  const Eigen::Matrix2d& error = scans.front().detection->covariance;
  if (!(interval > 0.0) || error(0, 0) != error(1, 1) || error(0, 1) != 0.0) return false;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    if (std::abs(scans[i].time - scans[i - 1].time - interval) > kSameInterval * interval) {
      return false;
    }
    if (!scans[i].detection || scans[i].detection->covariance != error) return false;
  }
  return true;
}

bool are_alike(const LabelledObject& a, const LabelledObject& b) {
  const double interval = a.scans[1].time - a.scans[0].time;
  return a.scans.size() == b.scans.size() &&
         std::abs(b.scans[1].time - b.scans[0].time - interval) <= kSameInterval * interval &&
         a.scans.front().detection->covariance == b.scans.front().detection->covariance;
}

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

using Matrix3 = Eigen::Matrix3d;

Matrix3 matrix_of(const AxisCovariance<double>& p) {
  Matrix3 m;
  m << p.xx, p.xv, p.xa, p.xv, p.vv, p.va, p.xa, p.va, p.aa;
  return m;
}

}  // namespace

std::optional<EvenObjects> EvenObjects::among(std::span<const LabelledObject* const> objects,
                                              std::vector<const LabelledObject*>& others) {
  const LabelledObject* first = nullptr;
  std::vector<const LabelledObject*> alike;
  for (const LabelledObject* object : objects) {
    const bool fits = is_even(*object) && (first == nullptr || are_alike(*first, *object));
    if (fits && first == nullptr) first = object;
    (fits ? alike : others).push_back(object);
  }
  if (first == nullptr) return std::nullopt;
  EvenObjects even;
  even.lanes_ = 2 * alike.size();
  even.scans_ = first->scans.size();
  even.interval_ = first->scans[1].time - first->scans[0].time;
  even.error_ = first->scans.front().detection->covariance;
  even.truth_.reserve(even.lanes_ * even.scans_);
  even.measured_.reserve(even.lanes_ * even.scans_);
  for (std::size_t i = 0; i < even.scans_; ++i) {
    for (const LabelledObject* object : alike) {
      const ObjectScan& scan = object->scans[i];
      for (int axis = 0; axis < 2; ++axis) {
        even.truth_.push_back(scan.truth.position[axis]);
        even.measured_.push_back(scan.detection->position[axis]);
      }
    }
  }
  return even;
}

Mean EvenObjects::expected_error(GainFilter<2> filter) const {
  std::vector<double> x(truth_.begin(), truth_.begin() + static_cast<std::ptrdiff_t>(lanes_));
  std::vector<double> v(lanes_), a(lanes_);
  filter.start(Eigen::Vector2d::Zero(), error_);
  double lag = 0.0, noise = 0.0;
  for (std::size_t i = 1; i < scans_; ++i) {
    const std::span<const double> truth(truth_.data() + i * lanes_, lanes_);
    filter.predict(interval_);
    filter.update(Eigen::Vector2d::Zero(), error_);
    const double h = filter.used_interval();
    const Gains& gains = filter.used_gains();
    BatchGains<double> step(gains, interval_);
    step.h_per_dt = gains.h / h;
    step.k2_per_dt2 = 2.0 * gains.k / (h * h);
    if (gains.order >= 2) {
      step_batch(step, x, v, a, truth, {});
    } else {
      step_batch(step, x, v, truth);
    }
    if (i < kFirstScan) continue;
    lag += square_of_difference(x, truth);
    noise += filter.noise_sigma().squaredNorm();
  }
  const auto objects = static_cast<double>(lanes_ / 2);
  const double weight = objects * static_cast<double>(scans_ - kFirstScan);
  Mean mean;
  mean.add((lag + objects * noise) / weight, weight);
  return mean;
}

/// Of Rauch, Tung and Striebel (1965): x ← x + G (x⁺ − F x), G = P Fᵀ P'⁻¹.
Mean EvenObjects::smoothed_error(int order, const AxisCovariance<double>& noise,
                                 const AxisGain<double>& spread) const {
  const double r = error_(0, 0);
  const double t = interval_;
  const double half = 0.5 * t * t;
  AxisCovariance<double> p{r,   0.0,
                           0.0, order >= 1 ? spread.v * spread.v : 0.0,
                           0.0, order >= 2 ? spread.a * spread.a : 0.0};
  Matrix3 motion;
  motion << 1.0, t, half, 0.0, 1.0, t, 0.0, 0.0, 1.0;

  std::vector<double> x(scans_ * lanes_), v(x.size()), a(x.size());  // lane by lane of each scan
  std::copy_n(measured_.begin(), lanes_, x.begin());
  std::vector<Matrix3> gains;  // of the smoother, from each scan to the one before
  gains.reserve(scans_);
  for (std::size_t i = 1; i < scans_; ++i) {
    AxisCovariance<double> predicted = extrapolated(p, t);
    predicted += noise;
    // What is not carried is known to be nothing, with any certainty.
    Matrix3 foreseen = matrix_of(predicted);
    for (int d = order + 1; d < 3; ++d) foreseen(d, d) = 1.0;
    gains.push_back(matrix_of(p) * motion.transpose() * foreseen.inverse());
    const double s = predicted.xx + r;
    const AxisGain<double> k{predicted.xx / s, predicted.xv / s, predicted.xa / s};
    p = corrected(predicted, k, r);
    for (std::size_t j = i * lanes_; j < (i + 1) * lanes_; ++j) {
      const std::size_t before = j - lanes_;
      const double foreseen_x = x[before] + t * v[before] + half * a[before];
      const double residual = measured_[j] - foreseen_x;
      x[j] = foreseen_x + k.x * residual;
      v[j] = v[before] + t * a[before] + k.v * residual;
      a[j] = a[before] + k.a * residual;
    }
  }

  const auto of_scan = [&](const std::vector<double>& values, std::size_t scan) {
    return std::span<const double>(values.data() + scan * lanes_, lanes_);
  };
  double sum = square_of_difference(of_scan(x, scans_ - 1), of_scan(truth_, scans_ - 1));
  for (std::size_t i = scans_ - 1; i-- > kFirstScan;) {
    const Matrix3& g = gains[i];
    for (std::size_t j = i * lanes_; j < (i + 1) * lanes_; ++j) {
      const std::size_t after = j + lanes_;
      const double dx = x[after] - (x[j] + t * v[j] + half * a[j]);
      const double dv = v[after] - (v[j] + t * a[j]);
      const double da = a[after] - a[j];
      x[j] += g(0, 0) * dx + g(0, 1) * dv + g(0, 2) * da;
      v[j] += g(1, 0) * dx + g(1, 1) * dv + g(1, 2) * da;
      a[j] += g(2, 0) * dx + g(2, 1) * dv + g(2, 2) * da;
    }
    sum += square_of_difference(of_scan(x, i), of_scan(truth_, i));
  }
  const double weight = static_cast<double>(lanes_ / 2) * static_cast<double>(scans_ - kFirstScan);
  Mean mean;
  mean.add(sum / weight, weight);
  return mean;
}

}  // namespace ghtrack

#include "tracker/filters/least_squares_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ghtrack {
namespace {

constexpr double kSameStep = 1e-6;  // relative; times are rounded

/// Σ (τ − dt)ⁱ from Σ τⁱ. No digits cancel: τ ≤ 0.
std::array<double, 5> later(const std::array<double, 5>& m, double dt) {
  const double s = -dt;
  return {m[0], m[1] + s * m[0], m[2] + s * (2.0 * m[1] + s * m[0]),
          m[3] + s * (3.0 * m[2] + s * (3.0 * m[1] + s * m[0])),
          m[4] + s * (4.0 * m[3] + s * (6.0 * m[2] + s * (4.0 * m[1] + s * m[0])))};
}

/// What the times of the measurements say of the fit at the latest one.
struct TimeFit {
  std::array<double, 3> gain;      // of the latest residual: first column of N⁻¹
  std::array<double, 3> variance;  // of the fit, as multiples of σ²: diagonal of N⁻¹
};

/// @param m  Σ τⁱ, the latest measurement included
TimeFit fit_by_time(const std::array<double, 5>& m, int order) {
  const double n = m[0];
  if (order == 0) return {{1.0 / n, 0.0, 0.0}, {1.0 / n, 0.0, 0.0}};
  const double t = std::sqrt(m[2] / n);  // a typical time, so that all sums are of one size
  const double m1 = m[1] / t, m2 = n;
  const double minor = n * m2 - m1 * m1;
  if (order == 1) {
    return {{m2 / minor, -m1 / (minor * t), 0.0}, {m2 / minor, n / (minor * t * t), 0.0}};
  }
  const double m3 = m[3] / (t * t * t), m4 = m[4] / (t * t * t * t);
  const double c0 = m2 * m4 - m3 * m3;
  const double c1 = m2 * m3 - m1 * m4;
  const double c2 = m1 * m3 - m2 * m2;
  const double d = n * c0 + m1 * c1 + m2 * c2;
  const double t2 = t * t;
  return {{c0 / d, c1 / (d * t), 2.0 * c2 / (d * t2)},
          {c0 / d, (n * m4 - m2 * m2) / (d * t2), 4.0 * minor / (d * t2 * t2)}};
}

}  // namespace

template <int D>
LeastSquaresFilter<D>::LeastSquaresFilter(int order, double dt, double sigma,
                                          const Kinematics<D>& guess)
    : order_(order), dt_(dt), sigma_(sigma), guess_(guess) {
  if (order < 0 || order > 2) throw std::invalid_argument("order must be 0, 1 or 2");
  if (!(dt > 0.0) || !std::isfinite(dt)) throw std::invalid_argument("dt must be positive");
}

template <int D>
bool LeastSquaresFilter<D>::predict(double dt) {
  const Kinematics<D> next = extrapolated(estimate_, dt);
  if (!(dt > 0.0) || !std::isfinite(dt) || !next.is_finite()) {
    ++refusals_.times;
    return false;
  }
  prior_ = estimate_ = next;
  residual_.reset();
  elapsed_ += dt;
  moments_ = later(moments_, dt);
  return true;
}

template <int D>
bool LeastSquaresFilter<D>::start(const Vector& z) {
  reset();
  if (!z.allFinite()) {
    ++refusals_.measurements;
    return false;
  }
  prior_.position = estimate_.position = z;
  moments_[0] = 1.0;
  updates_ = 1;
  return true;
}

template <int D>
bool LeastSquaresFilter<D>::update(const Vector& z) {
  const Vector residual = z - estimate_.position;
  std::array<double, 5> moments = moments_;
  moments[0] += 1.0;
  const bool is_even = is_even_ && (updates_ == 0 || std::abs(elapsed_ / dt_ - 1.0) <= kSameStep);
  Gains gains = growing_memory_gains(order_, updates_ + 1);
  if (!is_even) {
    // As many derivatives as there are points for.
    const auto [x, v, a] = fit_by_time(moments, std::min(order_, updates_)).gain;
    gains = {order_, x, v * dt_, 0.5 * a * dt_ * dt_};
  }
  const Kinematics<D> next = corrected(estimate_, residual, gains, dt_);
  if (!residual.allFinite() || !next.is_finite()) {
    ++refusals_.measurements;
    return false;
  }
  prior_ = estimate_;
  estimate_ = next;
  residual_ = residual;
  used_ = gains;
  moments_ = moments;
  is_even_ = is_even;
  elapsed_ = 0.0;
  ++updates_;
  return true;
}

template <int D>
void LeastSquaresFilter<D>::reset() {
  *this = LeastSquaresFilter(order_, dt_, sigma_, guess_);
}

template <int D>
std::array<double, 3> LeastSquaresFilter<D>::errors() const {
  const double infinity = std::numeric_limits<double>::infinity();
  if (updates_ == 0) return {infinity, infinity, infinity};
  if (!is_even_ && updates_ > order_) {
    std::array<double, 3> errors = fit_by_time(moments_, order_).variance;
    for (double& error : errors) error = sigma_ * std::sqrt(error);
    return errors;
  }
  return growing_memory_sigma(order_, updates_, sigma_, dt_);
}

template class LeastSquaresFilter<1>;
template class LeastSquaresFilter<2>;
template class LeastSquaresFilter<3>;

}  // namespace ghtrack

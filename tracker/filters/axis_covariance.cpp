#include "tracker/filters/axis_covariance.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace ghtrack {
namespace {

AxisCovariance<double> white_noise(int order, double q, double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  if (order == 0) return {q * t, 0.0, 0.0, 0.0, 0.0, 0.0};
  if (order == 1) return {q * t3 / 3.0, q * t2 / 2.0, 0.0, q * t, 0.0, 0.0};
  return {q * t2 * t3 / 20.0, q * t2 * t2 / 8.0, q * t3 / 6.0, q * t3 / 3.0, q * t2 / 2.0, q * t};
}

AxisCovariance<double> random_walk(int order, double variance, double t) {
  AxisCovariance<double> q{};
  if (order == 0) q.xx = variance * t * t * t * t / 4.0;
  if (order == 1) q.vv = variance * t * t;
  if (order == 2) q.aa = variance;
  return q;
}

AxisCovariance<double> piecewise_constant(int order, double variance, double t) {
  const double x = 0.5 * t * t;
  AxisCovariance<double> q{};
  q.xx = variance * x * x;
  if (order >= 1) {
    q.xv = variance * x * t;
    q.vv = variance * t * t;
  }
  if (order >= 2) {
    q.xa = variance * x;
    q.va = variance * t;
    q.aa = variance;
  }
  return q;
}

AxisCovariance<double> one_step(ProcessModel model, int order, double intensity, double dt) {
  switch (model) {
    case ProcessModel::kPiecewiseConstant:
      return piecewise_constant(order, intensity * intensity, dt);
    case ProcessModel::kRandomWalk:
      return random_walk(order, intensity * intensity, dt);
    case ProcessModel::kWhiteNoise:
      return white_noise(order, intensity, dt);
  }
  return {};
}

/// Σ F(iT) Q F(iT)ᵀ for i = 0 … n − 1, in closed form and so for any n ≥ 1. [t] = T
AxisCovariance<double> many_steps(const AxisCovariance<double>& q, double t, double n) {
  const double s1 = n * (n - 1.0) / 2.0;                       // Σ i
  const double s2 = s1 * (2.0 * n - 1.0) / 3.0;                // Σ i²
  const double s3 = s1 * s1;                                   // Σ i³
  const double s4 = s2 * (3.0 * n * n - 3.0 * n - 1.0) / 5.0;  // Σ i⁴
  const double t2 = t * t;
  return {.xx = n * q.xx + 2.0 * s1 * t * q.xv + s2 * t2 * (q.vv + q.xa) + s3 * t * t2 * q.va +
                0.25 * s4 * t2 * t2 * q.aa,
          .xv = n * q.xv + s1 * t * (q.vv + q.xa) + 1.5 * s2 * t2 * q.va + 0.5 * s3 * t * t2 * q.aa,
          .xa = n * q.xa + s1 * t * q.va + 0.5 * s2 * t2 * q.aa,
          .vv = n * q.vv + 2.0 * s1 * t * q.va + s2 * t2 * q.aa,
          .va = n * q.va + s1 * t * q.aa,
          .aa = n * q.aa};
}

AxisCovariance<double> scaled(const AxisCovariance<double>& q, double n) {
  return {n * q.xx, n * q.xv, n * q.xa, n * q.vv, n * q.va, n * q.aa};
}

}  // namespace

AxisCovariance<double> process_noise(ProcessModel model, int order, double intensity, double dt,
                                     double renewal) {
  constexpr double kSameInterval = 1e-6;  // times are rounded
  const double n = dt / renewal;
  const bool is_one = std::isinf(renewal) || std::abs(n - 1.0) <= kSameInterval;
  if (is_one || model == ProcessModel::kWhiteNoise || !std::isfinite(n)) {
    return one_step(model, order, intensity, dt);
  }
  if (n > 1.0) return many_steps(one_step(model, order, intensity, renewal), renewal, n);
  // Its share: the variance of the highest derivative grows at the same pace. For order 0 that is
  // the position, for a random walk whatever jumps.
  if (order == 2) return scaled(one_step(model, order, intensity, dt), n);
  if (order == 1 && model == ProcessModel::kPiecewiseConstant) {
    return scaled(one_step(model, order, intensity, dt), 1.0 / n);
  }
  return scaled(one_step(model, order, intensity, renewal), n);
}

double intensity_of_index(ProcessModel model, double index, double sigma, double dt) {
  const double acceleration = index * sigma / (dt * dt);
  return model == ProcessModel::kWhiteNoise ? acceleration * acceleration * dt : acceleration;
}

AxisCovariance<double> settled_prediction(const AxisCovariance<double>& q, int order, double r,
                                          double dt) {
  using Eigen::Matrix3d;
  constexpr int kMostDoublings = 60;
  constexpr int kPolishingSteps = 40;
  constexpr double kSettled = 1e-15;
  // After 2ᵏ steps: Φ carries an error along, J is what the measurements say of the first state,
  // P the covariance of the last if the first was known.
  Matrix3d carry = Matrix3d::Zero();  // Φᵀ
  carry(0, 0) = 1.0;
  if (order >= 1) carry.row(1) << dt, 1.0, 0.0;
  if (order >= 2) carry.row(2) << 0.5 * dt * dt, dt, 1.0;
  Matrix3d said = Matrix3d::Zero();
  said(0, 0) = 1.0 / r;
  Matrix3d p;
  p << q.xx, q.xv, q.xa, q.xv, q.vv, q.va, q.xa, q.va, q.aa;
  for (int doubling = 0; doubling < kMostDoublings; ++doubling) {
    const Matrix3d combined = (Matrix3d::Identity() + said * p).inverse();
    const Matrix3d added = carry.transpose() * (p * combined) * carry;
    const Matrix3d step = carry * combined;
    said += step * said * carry.transpose();
    carry = step * carry;
    p += added;
    if ((added.diagonal().array() <= kSettled * p.diagonal().array()).all()) break;
  }
  AxisCovariance<double> settled{p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2)};
  // Single steps take away what rounding has left where Q is large: there each forgets much.
  for (int step = 0; step < kPolishingSteps; ++step) {
    const double s = settled.xx + r;
    settled =
        extrapolated(corrected(settled, {settled.xx / s, settled.xv / s, settled.xa / s}, r), dt);
    settled += q;
  }
  return settled;
}

Gains steady_kalman_gains(ProcessModel model, int order, double intensity, double sigma,
                          double dt) {
  const double r = sigma * sigma;
  const AxisCovariance<double> p =
      settled_prediction(process_noise(model, order, intensity, dt), order, r, dt);
  const double s = p.xx + r;
  return {order, p.xx / s, dt * p.xv / s, 0.5 * dt * dt * p.xa / s};
}

}  // namespace ghtrack

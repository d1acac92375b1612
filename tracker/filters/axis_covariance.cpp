#include "tracker/filters/axis_covariance.hpp"

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

}  // namespace

AxisCovariance<double> process_noise(ProcessModel model, int order, double intensity, double dt) {
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

double intensity_of_index(ProcessModel model, double index, double sigma, double dt) {
  const double acceleration = index * sigma / (dt * dt);
  return model == ProcessModel::kWhiteNoise ? acceleration * acceleration * dt : acceleration;
}

Gains steady_kalman_gains(ProcessModel model, int order, double intensity, double sigma,
                          double dt) {
  constexpr int kMostSteps = 100000;
  const double r = sigma * sigma;
  const AxisCovariance<double> q = process_noise(model, order, intensity, dt);
  AxisCovariance<double> p{r, 0.0, 0.0, 0.0, 0.0, 0.0};
  if (order >= 1) p.vv = r / (dt * dt);
  if (order >= 2) p.aa = r / (dt * dt * dt * dt);
  Gains gains{order, 0.0, 0.0, 0.0};
  for (int step = 0; step < kMostSteps; ++step) {
    p = extrapolated(p, dt);
    p += q;
    const double s = p.xx + r;
    const Gains next{order, p.xx / s, dt * p.xv / s, 0.5 * dt * dt * p.xa / s};
    const double change = std::max(
        {std::abs(next.g - gains.g), std::abs(next.h - gains.h), std::abs(next.k - gains.k)});
    gains = next;
    if (change < 1e-16) break;
    p = corrected(p, {p.xx / s, p.xv / s, p.xa / s}, r);
  }
  return gains;
}

}  // namespace ghtrack

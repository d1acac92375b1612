#include "sim/gust_process.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

Eigen::Matrix2d transition_over(double x) {
  const double decay = portable::exp(-x);
  Eigen::Matrix2d transition;
  transition << decay, 0.0, x * decay, decay;
  return transition;
}

/// ∫₀ˣ 2 uⁿ e^(−2u) du, by its series where the closed form would cancel.
double noise_integral(int n, double x) {
  if (x > 1.0) {
    const double e = portable::exp(-2.0 * x);
    if (n == 0) return 1.0 - e;
    if (n == 1) return 0.5 * (1.0 - e * (1.0 + 2.0 * x));
    return 0.5 * (1.0 - e * (1.0 + 2.0 * x + 2.0 * x * x));
  }
  double power = 2.0 * x;
  for (int i = 0; i < n; ++i) power *= x;
  double sum = 0.0;
  for (int k = 0; k < 30; ++k) {
    sum += power / (n + 1 + k);
    power *= -2.0 * x / (k + 1);
  }
  return sum;
}

/// Covariance of (z1, z2) after the time x T, given the state before.
Eigen::Matrix2d noise_over(double x) {
  Eigen::Matrix2d noise;
  noise << noise_integral(0, x), noise_integral(1, x), noise_integral(1, x), noise_integral(2, x);
  return noise;
}

Eigen::Matrix2d root_of(const Eigen::Matrix2d& covariance) { return covariance.llt().matrixL(); }

}  // namespace

Eigen::RowVector2d GustProcess::longitudinal(double sigma) {
  return sigma * Eigen::RowVector2d(1.0, 0.0);
}

Eigen::RowVector2d GustProcess::transverse(double sigma) {
  return sigma * Eigen::RowVector2d(std::sqrt(1.5), (1.0 - std::sqrt(3.0)) / std::sqrt(2.0));
}

GustProcess::GustProcess(const Eigen::RowVector2d& output, double time) : output_(output) {
  double x = kBlock / (kKnotsPerSecond * time);
  transition_ = transition_over(x);
  spread_ = root_of(noise_over(x));
  for (Halving& halving : halvings_) {
    x *= 0.5;
    const Eigen::Matrix2d transition = transition_over(x);
    const Eigen::Matrix2d noise = noise_over(x);
    const Eigen::Matrix2d spread_at_end = transition * noise * transition.transpose() + noise;
    const Eigen::Matrix2d gain = noise * transition.transpose() * spread_at_end.inverse();
    halving.from_left = transition - gain * transition * transition;
    halving.from_right = gain;
    halving.spread = root_of(noise - gain * transition * noise);
  }
}

Eigen::Vector2d GustProcess::draw(Stream& stream) {
  const double first = stream.normal();
  const double second = stream.normal();
  return {first, second};
}

GustProcess::State GustProcess::start(Stream& stream) {
  Eigen::Matrix2d covariance;
  covariance << 1.0, 0.5, 0.5, 0.5;
  const Eigen::Matrix2d spread = root_of(covariance);
  return spread * draw(stream);
}

std::array<double, GustProcess::kBlock + 1> GustProcess::fill(const State& left, const State& right,
                                                              Stream& stream) const {
  std::array<State, kBlock + 1> states;
  states.front() = left;
  states.back() = right;
  std::size_t width = kBlock;
  for (const Halving& halving : halvings_) {
    for (std::size_t knot = 0; knot < kBlock; knot += width) {
      states[knot + width / 2] = halving.from_left * states[knot] +
                                 halving.from_right * states[knot + width] +
                                 halving.spread * draw(stream);
    }
    width /= 2;
  }
  std::array<double, kBlock + 1> velocities{};
  for (std::size_t knot = 0; knot <= kBlock; ++knot) {
    velocities[knot] = (output_ * states[knot]).value();
  }
  return velocities;
}

}  // namespace ghtrack

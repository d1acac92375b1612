#include "sim/process_noise.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kInterval = 1.0 / ProcessNoise::kKnotsPerSecond;  // [s]

/// Σ xⁱ / (i + k)!: φ₁ = (eˣ − 1)/x, φ₂ = (eˣ − 1 − x)/x², …, without cancellation; |x| ≤ 0.1.
double phi(int k, double x) {
  double term = 1.0;
  for (int i = 2; i <= k; ++i) term /= i;
  double sum = 0.0;
  for (int i = 1; i <= 12; ++i) {
    sum += term;
    term *= x / (k + i);
  }
  return sum;
}

}  // namespace

ProcessNoise::ProcessNoise(const ProcessNoiseConfig& config, const RandomSource& source)
    : source_(source), strays_(!std::holds_alternative<NoProcessNoise>(config.model)) {
  if (const auto* white = std::get_if<WhiteAcceleration>(&config.model)) {
    laws_.fill(integrated_white(2, white->spectral_density));
  }
  if (const auto* manoeuvres = std::get_if<SingerAcceleration>(&config.model)) {
    laws_.fill(singer(manoeuvres->sigma, manoeuvres->time));
  }
  if (const auto* turn = std::get_if<NoisyTurn>(&config.model)) {
    turns_ = true;
    const double rate = turn->turn_rate_deg * portable::kPi / 180.0;
    laws_ = {integrated_white(2, rate * rate), integrated_white(1, turn->speed * turn->speed)};
  }
}

/// A Wiener process, order 1, or its integral, with covariance
///   q [h³/3 h²/2; h²/2 h] (Bar-Shalom, Li & Kirubarajan 2001, equation 6.2.2-12).
ProcessNoise::Law ProcessNoise::integrated_white(int order, double density) {
  constexpr double h = kInterval;
  Law law{.order = order};
  const double root = std::sqrt(density * h);
  if (order == 1) {
    law.transition(0, 0) = 1.0;
    law.spread(0, 0) = root;
    return law;
  }
  law.transition.topLeftCorner<2, 2>() << 1.0, h, 0.0, 1.0;
  law.spread.topLeftCorner<2, 2>() << root * h / std::sqrt(3.0), 0.0, root * std::sqrt(0.75),
      0.5 * root;
  return law;
}

/// Singer 1970, equations 11 and 14, as integrals: an impulse of the noise leaves
///   g(s) = ((αs − 1 + e^(−αs))/α², (1 − e^(−αs))/α, e^(−αs))
/// after the time s, and the covariance is 2ασ² ∫ g gᵀ ds, by Gauss–Legendre quadrature.
ProcessNoise::Law ProcessNoise::singer(double sigma, double time) {
  constexpr std::array<double, 5> kNodes{-0.9061798459386640, -0.5384693101056831, 0.0,
                                         0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> kWeights{0.2369268850561891, 0.4786286704993665,
                                           0.5688888888888889, 0.4786286704993665,
                                           0.2369268850561891};
  const double rate = 1.0 / time;
  const auto response = [rate](double s) {
    return Eigen::Vector3d(s * s * phi(2, -rate * s), s * phi(1, -rate * s),
                           portable::exp(-rate * s));
  };
  constexpr double h = kInterval;
  Law law{.order = 3};
  law.transition << 1.0, h, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0;
  law.transition.col(2) = response(h);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    const Eigen::Vector3d g = response(0.5 * h * (1.0 + kNodes[i]));
    covariance += h * rate * kWeights[i] * g * g.transpose();
  }
  law.spread = sigma * Eigen::Matrix3d(covariance.llt().matrixL());
  law.sigma_at_start = sigma;
  return law;
}

ProcessNoise::State ProcessNoise::start() const {
  State state;
  if (!strays_) return state;
  Stream stream(source_.seed, Purpose::kProcessNoise, source_.key, 0);
  for (std::size_t axis = 0; axis < laws_.size(); ++axis) {
    const Law& law = laws_[axis];
    state.right[axis][law.order - 1] = law.sigma_at_start * stream.normal();
  }
  state.interval = -1;
  follow(state);
  return state;
}

void ProcessNoise::follow(State& state) const {
  ++state.interval;
  state.left = state.right;
  Stream stream(source_.seed, Purpose::kProcessNoise, source_.key,
                static_cast<std::uint64_t>(state.interval) + 1);
  for (std::size_t axis = 0; axis < laws_.size(); ++axis) {
    Eigen::Vector3d draws = Eigen::Vector3d::Zero();
    for (int i = 0; i < laws_[axis].order; ++i) draws[i] = stream.normal();
    state.right[axis] = laws_[axis].transition * state.left[axis] + laws_[axis].spread * draws;
  }
}

void ProcessNoise::advance(State& state, double elapsed) const {
  if (!strays_) return;
  const auto interval = static_cast<std::int64_t>(std::floor(elapsed * kKnotsPerSecond + 1e-6));
  while (state.interval < interval) follow(state);
}

Course ProcessNoise::at(const State& state, double elapsed, int axis) const {
  constexpr double h = kInterval;
  const auto index = static_cast<std::size_t>(axis);
  const Eigen::Vector3d& from = state.left[index];
  const Eigen::Vector3d& to = state.right[index];
  const double s = elapsed - static_cast<double>(state.interval) * h;
  const int order = laws_[index].order;
  // Coefficients of s³, s⁴ and s⁵ beside from[0] + from[1] s + ½ c₂ s²; those of the Hermite
  // polynomials of degree 1, 3 and 5.
  double slope = from[1];
  double bend = 0.0;
  double c3 = 0.0;
  double c4 = 0.0;
  double c5 = 0.0;
  if (order == 1) {
    slope = (to[0] - from[0]) / h;
  } else if (order == 2) {
    const double way = to[0] - from[0] - h * from[1];
    const double change = h * (to[1] - from[1]);
    bend = 2.0 * (3.0 * way - change) / (h * h);
    c3 = (change - 2.0 * way) / (h * h * h);
  } else if (order == 3) {
    bend = from[2];
    const double way = to[0] - from[0] - h * (from[1] + 0.5 * h * from[2]);
    const double change = h * (to[1] - from[1] - h * from[2]);
    const double jerk = h * h * (to[2] - from[2]);
    c3 = (10.0 * way - 4.0 * change + 0.5 * jerk) / (h * h * h);
    c4 = (7.0 * change - 15.0 * way - jerk) / (h * h * h * h);
    c5 = (6.0 * way - 3.0 * change + 0.5 * jerk) / (h * h * h * h * h);
  }
  return {from[0] + s * (slope + s * (0.5 * bend + s * (c3 + s * (c4 + s * c5)))),
          slope + s * (bend + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5))),
          bend + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5))};
}

}  // namespace ghtrack

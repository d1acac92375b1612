#include "tracker/filters/gains/analysis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/effort.hpp"
#include "tests/tracker/filters/random_gains.hpp"
#include "tracker/filters/batch.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

using testing::random_gains;
using testing::random_stable_gains;

template <int N>
using Square = Eigen::Matrix<double, N, N>;
template <int N>
using Column = Eigen::Matrix<double, N, 1>;

/// Motion of the state in one step, N − 1 = order.
template <int N>
Square<N> motion(double dt) {
  Square<N> f = Square<N>::Identity();
  if constexpr (N >= 2) f(0, 1) = dt;
  if constexpr (N >= 3) {
    f(0, 2) = 0.5 * dt * dt;
    f(1, 2) = dt;
  }
  return f;
}

template <int N>
Column<N> gain_column(const Gains& q, double dt) {
  Column<N> gain;
  gain[0] = q.g;
  if constexpr (N >= 2) gain[1] = q.h / dt;
  if constexpr (N >= 3) gain[2] = 2.0 * q.k / (dt * dt);
  return gain;
}

/// (I − K H) F, which carries the error of the estimate from update to update.
template <int N>
Square<N> error_transition(const Gains& q, double dt) {
  Square<N> keep = Square<N>::Identity();
  keep.col(0) -= gain_column<N>(q, dt);
  return keep * motion<N>(dt);
}

/// P = A P Aᵀ + K Kᵀ: the sum of Aⁿ K Kᵀ Aⁿᵀ, whose terms double in number with each step (R. A.
/// Smith, Matrix equation XA + BX = C, 1968).
template <int N>
Square<N> lyapunov(const Gains& q, double dt) {
  Square<N> power = error_transition<N>(q, dt);
  const Column<N> gain = gain_column<N>(q, dt);
  Square<N> sum = gain * gain.transpose();
  for (int doubled = 0; doubled < 20; ++doubled) {  // 0.99^(2^20) is nothing
    sum += (power * sum * power.transpose()).eval();
    power = (power * power).eval();
  }
  return sum;
}

void expect_relative(double value, double expected, double tolerance, const char* what) {
  EXPECT_LE(std::abs(value - expected), tolerance * (std::abs(expected) + 1e-12)) << what;
}

template <int N>
void compare_with_lyapunov(std::mt19937_64& engine) {
  const Gains q = random_stable_gains(N - 1, 0.99, engine);
  const double dt = 0.3;
  const Square<N> p = lyapunov<N>(q, dt);
  const Square<N> f = motion<N>(dt);
  const Square<N> predicted = f * p * f.transpose();
  const VarianceReduction vrf = variance_reduction(q, dt);
  expect_relative(vrf.x, p(0, 0), 1e-9, "x");
  expect_relative(vrf.prediction, predicted(0, 0), 1e-9, "prediction");
  if constexpr (N >= 2) {
    expect_relative(vrf.dx, p(1, 1), 1e-9, "dx");
    EXPECT_NEAR(vrf.x_dx, p(0, 1), 1e-9 * std::sqrt(p(0, 0) * p(1, 1)));
  }
  if constexpr (N >= 3) expect_relative(vrf.ddx, p(2, 2), 1e-9, "ddx");
}

// Derived: the discrete Lyapunov equation of the error's covariance.
TEST(VarianceReduction, SolvesTheLyapunovEquationForRandomStableGains) {
  std::mt19937_64 engine(1);
  for (int i = 0; i < 1000; ++i) {
    compare_with_lyapunov<1>(engine);
    compare_with_lyapunov<2>(engine);
    compare_with_lyapunov<3>(engine);
  }
}

/// Sample variance of the position error of many filters that saw pure noise.
double simulated_variance(const Gains& gains, std::mt19937_64& engine, std::size_t filters) {
  constexpr int kSteps = 60;  // 0.85^(2·60) = 3e-9 is left of the start
  std::normal_distribution<double> noise;
  std::vector<double> x(filters, 0.0);
  std::vector<double> v(filters, 0.0);
  std::vector<double> a(filters, 0.0);
  std::vector<double> z(filters);
  const BatchGains<double> batch(gains, 1.0);
  for (int step = 0; step < kSteps; ++step) {
    for (double& value : z) value = noise(engine);
    step_batch(batch, x, v, a, z, {});
  }
  double squares = 0.0;
  for (const double error : x) squares += error * error;
  return squares / static_cast<double>(filters);
}

// Derived: the closed form is the variance of an ensemble. A sample variance of n values has the
// relative standard error √(2/n); the mean of 1000 such ratios √(2/1000n).
TEST(VarianceReduction, IsTheSpreadOfAnEnsemble) {
  constexpr std::size_t kFilters = 200;
  constexpr int kGains = 1000;
  const double one = std::sqrt(2.0 / static_cast<double>(kFilters));
  std::mt19937_64 engine(2);
  double ratios = 0.0;
  for (int i = 0; i < kGains; ++i) {
    const Gains gains = random_stable_gains(1 + i % 2, 0.85, engine);
    const double ratio =
        simulated_variance(gains, engine, kFilters) / variance_reduction(gains, 1.0).x;
    EXPECT_NEAR(ratio, 1.0, 6.0 * one);
    ratios += ratio / kGains;
  }
  EXPECT_NEAR(ratios, 1.0, 4.0 * one / std::sqrt(kGains));
}

/// Error truth − estimate after a long noiseless run along c t^(order + 1) / (order + 1)!.
Lag simulated_lag(const Gains& q, double dt, double next_derivative) {
  constexpr int kSteps = 600;
  GainFilter<1> filter(q, dt, {});
  Lag lag;
  const auto truth = [&](double t) {
    const double c = next_derivative;
    if (q.order == 0) return Eigen::Vector3d(c * t, 0.0, 0.0);
    if (q.order == 1) return Eigen::Vector3d(0.5 * c * t * t, c * t, 0.0);
    return Eigen::Vector3d(c * t * t * t / 6.0, 0.5 * c * t * t, c * t);
  };
  for (int step = 1; step <= kSteps; ++step) {
    const Eigen::Vector3d now = truth(step * dt);
    filter.predict(dt);
    lag.prediction = now[0] - filter.estimate().position[0];
    filter.update(Eigen::Matrix<double, 1, 1>(now[0]));
    lag.x = now[0] - filter.estimate().position[0];
    lag.dx = now[1] - filter.estimate().velocity[0];
    lag.ddx = now[2] - filter.estimate().acceleration[0];
  }
  return lag;
}

// Derived: noiseless simulation; 0.94^600 = 8e-17 is left of the start.
TEST(SteadyLag, IsWhatANoiselessFilterEndsWith) {
  std::mt19937_64 engine(3);
  for (int i = 0; i < 1000; ++i) {
    const int order = i % 3;
    const Gains gains = random_stable_gains(order, 0.94, engine);
    const double dt = 0.5;
    const Lag expected = steady_lag(gains, dt, -1.7);
    const Lag found = simulated_lag(gains, dt, -1.7);
    const double scale = 1e-6 * (1.0 + std::abs(expected.prediction));
    EXPECT_NEAR(found.prediction, expected.prediction, scale);
    EXPECT_NEAR(found.x, expected.x, scale);
    if (order >= 1) {
      EXPECT_NEAR(found.dx, expected.dx, scale);
    }
    if (order >= 2) {
      EXPECT_NEAR(found.ddx, expected.ddx, scale);
    }
  }
}

/// Σ (first component)² of the prediction's error, from this error at the first prediction.
template <int N>
double simulated_energy(const Gains& q, double dt, Column<N> error) {
  Square<N> keep = Square<N>::Identity();
  keep.col(0) -= gain_column<N>(q, dt);
  const Square<N> next = motion<N>(dt) * keep;
  double energy = 0.0;
  for (int step = 0; step < 1500; ++step) {
    energy += error[0] * error[0];
    error = next * error;
  }
  return energy;
}

// Derived: the sum over a noiseless transient.
TEST(TransientEnergy, IsTheSumOverANoiselessTransient) {
  std::mt19937_64 engine(4);
  const double dt = 0.7;
  for (int i = 0; i < 200; ++i) {
    const Gains one = random_stable_gains(0, 0.98, engine);
    const Gains two = random_stable_gains(1, 0.98, engine);
    const Gains three = random_stable_gains(2, 0.98, engine);
    const TransientEnergy a = transient_energy(one, dt);
    const TransientEnergy b = transient_energy(two, dt);
    const TransientEnergy c = transient_energy(three, dt);
    const auto e2 = [](int i_th) { return Column<2>(Column<2>::Unit(i_th)); };
    const auto e3 = [](int i_th) { return Column<3>(Column<3>::Unit(i_th)); };
    expect_relative(a.position, simulated_energy<1>(one, dt, Column<1>(1.0)), 1e-9, "order 0");
    expect_relative(b.position, simulated_energy<2>(two, dt, e2(0)), 1e-9, "position");
    expect_relative(b.velocity, simulated_energy<2>(two, dt, e2(1)), 1e-9, "velocity");
    expect_relative(c.position, simulated_energy<3>(three, dt, e3(0)), 1e-9, "position");
    expect_relative(c.velocity, simulated_energy<3>(three, dt, e3(1)), 1e-9, "velocity");
    expect_relative(c.acceleration, simulated_energy<3>(three, dt, e3(2)), 1e-9, "acceleration");
  }
}

/// The size of the largest eigenvalue, lim ‖Aⁿ‖^(1/n) (I. Gelfand, Normierte Ringe, 1941): n
/// doubles with each step.
template <int N>
double spectral_radius(Square<N> power) {
  double log_radius = 0.0;
  for (double share = 1.0; share > 1e-15; share *= 0.5) {
    const double scale = power.cwiseAbs().maxCoeff();
    if (scale == 0.0) return 0.0;
    log_radius += share * std::log(scale);
    power /= scale;
    power = (power * power).eval();
  }
  return std::exp(log_radius);
}

template <int N>
void compare_with_eigenvalues(int samples, std::mt19937_64& engine) {
  int disagreements = 0;
  int wrong_poles = 0;
  for (int i = 0; i < samples; ++i) {
    const Gains gains = random_gains(N - 1, engine);
    const double radius = spectral_radius<N>(error_transition<N>(gains, 1.0));
    if (std::abs(radius - 1.0) < 1e-9) continue;
    disagreements += is_stable(gains) != (radius < 1.0);
    wrong_poles += !(std::abs(std::abs(poles(gains).front()) - radius) < 1e-6 * (1.0 + radius));
  }
  EXPECT_EQ(disagreements, 0);
  EXPECT_EQ(wrong_poles, 0);
}

// Derived: eigenvalues of the error's transition matrix, a million sets of gains.
TEST(Stability, AgreesWithTheEigenvaluesOfPairs) {
  std::mt19937_64 engine(5);
  compare_with_eigenvalues<2>(testing::samples(500000), engine);
}
TEST(Stability, AgreesWithTheEigenvaluesOfTriples) {
  std::mt19937_64 engine(6);
  compare_with_eigenvalues<3>(testing::samples(500000), engine);
}

// Derived: one point outside each face of the stable region.
TEST(Stability, NamesTheInequalityThatIsViolated) {
  EXPECT_EQ(violated_inequality(Gains::of_g(0.0)), "0 < g");
  EXPECT_EQ(violated_inequality(Gains::of_g(2.0)), "g < 2");
  EXPECT_EQ(violated_inequality(Gains::of_gh(0.0, 0.1)), "0 < g");
  EXPECT_EQ(violated_inequality(Gains::of_gh(0.5, 0.0)), "0 < h");
  EXPECT_EQ(violated_inequality(Gains::of_gh(0.5, 3.5)), "2g + h < 4");
  EXPECT_EQ(violated_inequality(Gains::of_ghk(2.1, 0.1, 0.1)), "g < 2");
  EXPECT_EQ(violated_inequality(Gains::of_ghk(0.5, 3.5, 0.1)), "2g + h < 4");
  EXPECT_EQ(violated_inequality(Gains::of_ghk(0.5, 0.2, 0.0)), "0 < k");
  EXPECT_EQ(violated_inequality(Gains::of_ghk(0.5, 0.2, 0.07)), "k < g h / (2 - g)");
  EXPECT_EQ(violated_inequality(Gains::of_gh(std::nan(""), 0.1)), "0 < g");
  EXPECT_EQ(violated_inequality(Gains::of_gh(0.5, std::nan(""))), "0 < h");
  EXPECT_EQ(violated_inequality(Gains::of_ghk(0.5, 0.2, 0.05)), std::nullopt);
}

// Property: nothing steady is claimed of a filter that has no steady state.
TEST(Stability, IsRequiredForEverySteadyQuantity) {
  const Gains unstable = Gains::of_gh(0.5, 3.5);
  EXPECT_THROW(variance_reduction(unstable, 1.0), std::invalid_argument);
  EXPECT_THROW(steady_lag(unstable, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(transient_energy(unstable, 1.0), std::invalid_argument);
  EXPECT_THROW(settling_updates(unstable), std::invalid_argument);
}

// Derived: the sign of (g + h)² − 4h and of the poles.
TEST(Damping, OfPairsFollowsTheDiscriminant) {
  EXPECT_EQ(damping(Gains::of_gh(0.2, 0.02)), Damping::kUnder);
  EXPECT_EQ(damping(critically_damped_gains(0.2)), Damping::kCritical);
  EXPECT_EQ(damping(Gains::of_gh(0.2, 0.005)), Damping::kOver);
  EXPECT_EQ(damping(Gains::of_gh(1.2, 0.5)), Damping::kAlternating);
  EXPECT_EQ(damping(Gains::of_gh(0.99, 1.5)), Damping::kAlternating);
}

// Derived: fading memory has all its poles at θ.
TEST(Damping, OfFadingMemoryIsCriticalWithEqualPoles) {
  for (int order = 1; order <= 2; ++order) {
    for (const double theta : {0.1, 0.5, 0.8, 0.95, 0.99}) {
      const Gains gains = fading_memory_gains(order, theta);
      EXPECT_EQ(damping(gains), Damping::kCritical) << order << " " << theta;
      // A triple root is found to the cube root of the rounding error.
      for (const auto& pole : poles(gains)) EXPECT_NEAR(std::abs(pole - theta), 0.0, 3e-5);
    }
  }
}

// Derived: ζ of a Kalata pair tends to 1/√2, that of a triple to 1/2 (Kalata 1984).
TEST(Damping, RatioOfOptimalGainsTendsToTheClassicalValues) {
  EXPECT_NEAR(damping_ratio(tracking_index_gains(1, 1e-6)), std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(damping_ratio(tracking_index_gains(2, 1e-9)), 0.5, 1e-3);
  EXPECT_EQ(damping_ratio(Gains::of_gh(0.2, 0.005)), 1.0);
}

// Derived: |slowest pole|^n reaches the fraction.
TEST(Settling, CountsUpdatesOfTheSlowestPole) {
  EXPECT_NEAR(settling_updates(Gains::of_g(0.5), 0.125), 3.0, 1e-12);
  EXPECT_EQ(settling_updates(Gains::of_g(1.0)), 1.0);
}

}  // namespace
}  // namespace ghtrack

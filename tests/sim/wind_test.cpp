#include "sim/wind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kSigma = 5.0;
constexpr double kTau = 0.8;

Wind gusty(std::uint64_t seed, const TurbulenceConfig& turbulence,
           const Vec2& mean = Vec2::Zero()) {
  WindConfig config;
  config.mean = mean;
  config.turbulence = turbulence;
  return {config, 0.0, seed};
}

std::vector<Vec2> record(const Wind& wind, const Vec2& place, double rate, int samples) {
  std::vector<Vec2> values;
  for (int i = 0; i < samples; ++i) values.push_back(wind.at(place, i / rate));
  return values;
}

double mean_product(const std::vector<Vec2>& values, int axis, int lag) {
  double sum = 0.0;
  const std::size_t n = values.size() - static_cast<std::size_t>(lag);
  for (std::size_t i = 0; i < n; ++i) {
    sum += values[i][axis] * values[i + static_cast<std::size_t>(lag)][axis];
  }
  return sum / static_cast<double>(n);
}

/// Slope of the logarithm of the power spectrum over that of the frequency, from averaged
/// periodograms of windowed segments.
double spectral_slope(const std::vector<Vec2>& values, double rate, double from, double to) {
  constexpr std::size_t kSegment = 1024;
  std::vector<double> x;
  std::vector<double> y;
  for (double frequency = from; frequency <= to; frequency *= 1.15) {
    double power = 0.0;
    for (std::size_t begin = 0; begin + kSegment <= values.size(); begin += kSegment) {
      std::complex<double> sum = 0.0;
      for (std::size_t i = 0; i < kSegment; ++i) {
        const double hann = 1.0 - portable::sin_cos_of_turns(static_cast<double>(i) / kSegment).cos;
        const portable::SinCos wave =
            portable::sin_cos_of_turns(frequency * static_cast<double>(i) / rate);
        sum += hann * values[begin + i].x() * std::complex<double>(wave.cos, wave.sin);
      }
      power += std::norm(sum);
    }
    x.push_back(std::log(frequency));
    y.push_back(std::log(power));
  }
  double mx = 0.0;
  double my = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / static_cast<double>(x.size());
    my += y[i] / static_cast<double>(x.size());
  }
  double xy = 0.0;
  double xx = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mx) * (y[i] - my);
    xx += (x[i] - mx) * (x[i] - mx);
  }
  return xy / xx;
}

// T18. Derived: Ornstein–Uhlenbeck: variance σ² within four standard errors √(2τ/T),
// autocorrelation 1/e at τ (standard error √(τ/T)), spectrum falling as f⁻² from far above 1/2πτ to
// an eighth of the sampling rate; the same whether it is asked 60 or 240 times a second. Noise
// scaled by dt instead of √dt: 1.6 % of the variance at 60 Hz.
TEST(Wind, HasOrnsteinUhlenbeckGusts) {
  constexpr int kDuration = 1 << 14;  // [s]
  constexpr std::size_t kSpectrumSamples = 1 << 17;
  const Wind wind = gusty(5, {OrnsteinUhlenbeck{kSigma, kTau, 30.0}});
  for (const int rate : {60, 240}) {
    std::vector<Vec2> values = record(wind, Vec2(12.3, 4.5), rate, kDuration * rate);
    for (const int axis : {0, 1}) {
      const double variance = mean_product(values, axis, 0);
      EXPECT_NEAR(variance / (kSigma * kSigma), 1.0, 4.0 * std::sqrt(2.0 * kTau / kDuration))
          << rate;
      const double correlation =
          mean_product(values, axis, static_cast<int>(kTau * rate)) / variance;
      EXPECT_NEAR(correlation, std::exp(-1.0), 0.03) << rate;
    }
    values.resize(kSpectrumSamples);
    EXPECT_NEAR(spectral_slope(values, rate, 4.0 / (2.0 * portable::kPi * kTau), rate / 8.0), -2.0,
                0.15)
        << rate;
  }
}

// Derived: the blend of four lattice nodes keeps the variance at every place: over independent
// seeds the variance of the mean square is 2σ⁴/n.
TEST(Wind, HasTheSameVarianceBetweenLatticeNodes) {
  constexpr int kSeeds = 1500;
  for (const double x : {0.0, 7.5, 15.0, 22.0}) {
    double squares = 0.0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      squares += std::pow(
          gusty(seed, {OrnsteinUhlenbeck{kSigma, kTau, 30.0}}).at(Vec2(x, 11.0), 0.0).x(), 2);
    }
    EXPECT_NEAR(squares / kSeeds / (kSigma * kSigma), 1.0, 4.0 * std::sqrt(2.0 / kSeeds)) << x;
  }
}

// Derived: von Kármán's spectra, in units of U/aL, against those of the sum of Dryden turbulences.
TEST(Wind, SumsDrydenTurbulencesToVonKarmans) {
  double weights = 0.0;
  for (const DrydenPart& part : kVonKarmanParts) weights += part.weight;
  EXPECT_NEAR(weights, 1.0, 1e-12);
  const double scale = std::tgamma(5.0 / 6.0) / (std::sqrt(portable::kPi) * std::tgamma(1.0 / 3.0));
  for (double k = 0.01; k <= 100.0; k *= 1.1) {
    const double along = scale * std::pow(1.0 + k * k, -5.0 / 6.0);
    const double across = 0.5 * along * (1.0 + 8.0 / 3.0 * k * k) / (1.0 + k * k);
    double sum_along = 0.0;
    double sum_across = 0.0;
    for (const DrydenPart& part : kVonKarmanParts) {
      const double x = k / part.rate;
      const double one = part.weight / (portable::kPi * part.rate * (1.0 + x * x));
      sum_along += one;
      sum_across += 0.5 * one * (1.0 + 3.0 * x * x) / (1.0 + x * x);
    }
    EXPECT_NEAR(sum_along / along, 1.0, 0.025) << k;
    EXPECT_NEAR(sum_across / across, 1.0, 0.025) << k;
  }
}

// Derived: along the wind the autocorrelation is 2^(2/3)/Γ(1/3) z^(1/3) K_(1/3)(z), z = τ U/aL, and
// the spectrum falls as f^(−5/3). Dryden's falls as f⁻².
TEST(Wind, HasVonKarmanTurbulence) {
  constexpr double kSpeed = 20.0;
  constexpr double kRate = 60.0;
  constexpr int kSamples = 1 << 17;
  VonKarman karman;
  karman.intensity = 0.2;
  karman.height = 50.0;
  const Wind wind = gusty(4, {karman}, Vec2(kSpeed, 0.0));
  std::vector<Vec2> values = record(wind, Vec2(3.0, 10.0), kRate, kSamples);
  for (Vec2& value : values) value.x() -= kSpeed;
  const double feet = 50.0 / 0.3048;
  const double length = feet / std::pow(0.177 + 0.000823 * feet, 1.2) * 0.3048;
  const double time = 1.339 * length / kSpeed;
  const double error = 4.0 * std::sqrt(2.0 * time * kRate / kSamples);
  EXPECT_NEAR(mean_product(values, 0, 0) / (16.0), 1.0, error + 0.01);
  for (const int lag : {30, 120, 480}) {
    const double z = lag / kRate / time;
    const double expected = std::pow(2.0, 2.0 / 3.0) / std::tgamma(1.0 / 3.0) * std::cbrt(z) *
                            std::cyl_bessel_k(1.0 / 3.0, z);
    EXPECT_NEAR(mean_product(values, 0, lag) / 16.0, expected, error) << lag;
  }
  const double corner = 1.0 / (2.0 * portable::kPi * time);
  EXPECT_NEAR(spectral_slope(values, kRate, 8.0 * corner, 100.0 * corner), -5.0 / 3.0, 0.15);
}

// Derived: MIL-F-8785C at 10 m in 60 m/s with σ_u = 0.19 × 60: L_u = 67 m, so 1.12 s; across the
// wind σ_w = σ_u (0.177 + 0.000823 h)^0.4 and the transverse autocorrelation (1 − τ/2T) e^(−τ/T).
TEST(Wind, HasDrydenTurbulence) {
  constexpr double kSpeed = 60.0;
  constexpr double kRate = 60.0;
  constexpr int kSamples = 1 << 17;
  const Wind wind = gusty(9, {Dryden{0.19, 10.0, {}}}, Vec2(kSpeed, 0.0));
  std::vector<Vec2> values = record(wind, Vec2(3.0, 10.0), kRate, kSamples);
  for (Vec2& value : values) value.x() -= kSpeed;
  const double feet = 10.0 / 0.3048;
  const double shape = 0.177 + 0.000823 * feet;
  const double length = feet / std::pow(shape, 1.2) * 0.3048;
  EXPECT_NEAR(length, 67.0, 1.0);

  const double along = length / kSpeed;
  const double across = 10.0 / kSpeed;
  const double sigma_u = 0.19 * kSpeed;
  const double sigma_w = sigma_u * std::pow(shape, 0.4);
  const double error_u = 4.0 * std::sqrt(2.0 * along * kRate / kSamples);
  const double error_w = 4.0 * std::sqrt(2.0 * across * kRate / kSamples);
  EXPECT_NEAR(mean_product(values, 0, 0) / (sigma_u * sigma_u), 1.0, error_u + 0.003);
  // Linear interpolation between knots of 1/120 s takes up to δ/2T more off the shorter scale.
  EXPECT_NEAR(mean_product(values, 1, 0) / (sigma_w * sigma_w), 1.0, error_w + 0.05);
  for (const int lag : {6, 12, 24}) {
    const double x = lag / kRate / across;
    EXPECT_NEAR(mean_product(values, 1, lag) / mean_product(values, 1, 0),
                (1.0 - 0.5 * x) * std::exp(-x), 0.03)
        << lag;
  }
}

// Property: a gust depends on place, time and seed: not on what was asked before, nor in which
// order.
TEST(Wind, DoesNotDependOnTheOrderOfQuestions) {
  const TurbulenceConfig turbulence{OrnsteinUhlenbeck{kSigma, kTau, 30.0}};
  const Wind forwards = gusty(1, turbulence);
  const Wind backwards = gusty(1, turbulence);
  std::vector<Vec2> first;
  for (int i = 0; i < 200; ++i) first.push_back(forwards.at(Vec2(3.0 * i, 1.0), 0.37 * i));
  for (int i = 199; i >= 0; --i) {
    EXPECT_EQ(backwards.at(Vec2(3.0 * i, 1.0), 0.37 * i), first[static_cast<std::size_t>(i)]);
  }
}

// Derived: V r/R inside, V (R/r)^n outside, round the moving centre.
TEST(Wind, WhirlsRoundARankineVortex) {
  WindConfig config;
  config.vortices = {RankineVortex{Vec2(10.0, 0.0), Vec2(2.0, 0.0), 50.0, 80.0, 0.5}};
  const Wind wind(config, 0.0, 1);
  EXPECT_NEAR(wind.at(Vec2(50.0, 0.0), 0.0).y(), 25.0, 1e-12);
  EXPECT_NEAR(wind.at(Vec2(330.0, 0.0), 0.0).y(), 25.0, 1e-12);
  EXPECT_NEAR(wind.at(Vec2(60.0, 0.0), 5.0).y(), 25.0, 1e-12);
  EXPECT_NEAR(wind.at(Vec2(10.0, 0.0), 0.0).x(), 2.0, 1e-12);
}

// Derived: u*/κ ln(y/z0), measured from the ground; nothing below z0.
TEST(Wind, GrowsWithTheLogarithmOfHeight) {
  WindConfig config;
  config.shear.emplace(LogarithmicShear{0.4, 0.1, 0.4});
  const Wind wind(config, 100.0, 1);
  EXPECT_NEAR(wind.at(Vec2(0.0, 110.0), 0.0).x(), std::log(100.0), 1e-12);
  EXPECT_EQ(wind.at(Vec2(0.0, 100.05), 0.0).x(), 0.0);
}

// Derived: Dw/Dt of a steady vortex core is the centripetal acceleration −Ω² r.
TEST(Wind, AcceleratesAlongItsStreamlines) {
  WindConfig config;
  config.vortices = {RankineVortex{Vec2::Zero(), Vec2::Zero(), 40.0, 80.0, 1.0}};
  const Wind wind(config, 0.0, 1);
  EXPECT_NEAR(wind.material_derivative(Vec2(20.0, 0.0), 3.0, 0.0, 10.0).x(), -0.25 * 20.0, 1e-6);
}

// Derived: V/2 (π/d) sin(π (t − t0)/d) inside a smooth gust that has just begun, whatever was
// before.
TEST(Wind, AcceleratesOnTheRightSideOfAKink) {
  WindConfig config;
  config.gusts.emplace_back(OneMinusCosineGust{1.0, 2.0, Vec2(-30.0, 0.0)});
  config.gusts.emplace_back(OneMinusCosineGust{0.0, 1.0, Vec2(30.0, 0.0)});
  const Wind wind(config, 0.0, 1);
  const double first = 15.0 * portable::kPi * std::sin(portable::kPi * 0.5);
  EXPECT_NEAR(wind.material_derivative(Vec2::Zero(), 0.5, 0.0, 0.5).x(), first, 0.01);
  EXPECT_NEAR(wind.material_derivative(Vec2::Zero(), 1.0, 1.0, 3.0).x(), 0.0, 0.02);
}

// Property: the parts of an interval end at every jump of the wind.
TEST(Wind, IsIntegratedInSmoothParts) {
  WindConfig config;
  config.gusts.emplace_back(StepGust{0.3, Vec2(1.0, 0.0)});
  config.gusts.emplace_back(OneMinusCosineGust{0.5, 0.25, Vec2(1.0, 0.0)});
  const Wind wind(config, 0.0, 1);
  std::vector<double> ends;
  wind.over_smooth_parts(0.0, 1.0, [&](double, double end) { ends.push_back(end); });
  EXPECT_EQ(ends, (std::vector<double>{0.3, 0.5, 0.75, 1.0}));
}

}  // namespace
}  // namespace ghtrack

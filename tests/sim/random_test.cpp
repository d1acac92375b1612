#include "sim/random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace ghtrack {
namespace {

std::uint64_t mix(std::uint64_t hash, double value) {
  return (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3;
}

// Derived: FNV-1a of "" and "a" as published by Fowler, Noll and Vo.
TEST(KeyOf, IsFnv1a) {
  EXPECT_EQ(key_of(""), 0xcbf29ce484222325u);
  EXPECT_EQ(key_of("a"), 0xaf63dc4c8601ec8cu);
}

// Recorded: gcc 12 and clang 14, -O0 and -O3. A change here changes every seeded result of every
// user: do it for a good reason only, and replace the constant by the value in the message.
TEST(Stream, GivesTheSameBitsForEver) {
  std::uint64_t hash = 0;
  for (std::uint64_t step = 0; step < 100; ++step) {
    Stream stream(7, Purpose::kMeasurementNoise, key_of("fly ball"), step);
    for (int i = 0; i < 5; ++i) hash = mix(hash, stream.normal());
    hash = mix(hash, stream.uniform());
    hash = mix(hash, stream.poisson(3.0));
    hash = mix(hash, stream.student_t(4.0));
  }
  EXPECT_EQ(hash, 1041331915919504090u);
}

// Property: each part of a stream's name makes another stream.
TEST(Stream, DependsOnEveryPartOfItsName) {
  const std::uint64_t reference = Stream(1, Purpose::kLaunch, 2, 3).bits();
  EXPECT_EQ(Stream(1, Purpose::kLaunch, 2, 3).bits(), reference);
  EXPECT_NE(Stream(2, Purpose::kLaunch, 2, 3).bits(), reference);
  EXPECT_NE(Stream(1, Purpose::kLabel, 2, 3).bits(), reference);
  EXPECT_NE(Stream(1, Purpose::kLaunch, 3, 3).bits(), reference);
  EXPECT_NE(Stream(1, Purpose::kLaunch, 2, 4).bits(), reference);
  EXPECT_NE(Stream(1, Purpose::kLaunch, 2, 3 + (std::uint64_t{1} << 32)).bits(), reference);
  EXPECT_NE(Stream(1, Purpose::kLaunch, 2 + (std::uint64_t{1} << 32), 3).bits(), reference);
}

// Derived: moments 0, 1, 0, 3 of the normal law; four standard errors √(Var/n) of each, the
// variances of x, x², x³, x⁴ being 1, 2, 15, 96.
TEST(Stream, DrawsNormalsWithTheMomentsOfTheNormalLaw) {
  constexpr int kDraws = 400'000;
  Stream stream(11, Purpose::kMeasurementNoise, 0, 0);
  double m1 = 0.0;
  double m2 = 0.0;
  double m3 = 0.0;
  double m4 = 0.0;
  double lagged = 0.0;
  double previous = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = stream.normal();
    m1 += x;
    m2 += x * x;
    m3 += x * x * x;
    m4 += x * x * x * x;
    lagged += x * previous;
    previous = x;
  }
  const double standard_error = 1.0 / std::sqrt(kDraws);
  EXPECT_NEAR(m1 / kDraws, 0.0, 4.0 * standard_error);
  EXPECT_NEAR(m2 / kDraws, 1.0, 4.0 * std::sqrt(2.0) * standard_error);
  EXPECT_NEAR(m3 / kDraws, 0.0, 4.0 * std::sqrt(15.0) * standard_error);
  EXPECT_NEAR(m4 / kDraws, 3.0, 4.0 * std::sqrt(96.0) * standard_error);
  EXPECT_NEAR(lagged / kDraws, 0.0, 4.0 * standard_error);
}

// Derived: the first draws of neighbouring steps are independent standard normals too.
TEST(Stream, DrawsIndependentNormalsFromNeighbouringSteps) {
  constexpr int kSteps = 100'000;
  double sum = 0.0;
  double squares = 0.0;
  double lagged = 0.0;
  double previous = 0.0;
  for (std::uint64_t step = 0; step < kSteps; ++step) {
    const double x = Stream(3, Purpose::kTurbulence, 5, step).normal();
    sum += x;
    squares += x * x;
    lagged += x * previous;
    previous = x;
  }
  const double standard_error = 1.0 / std::sqrt(kSteps);
  EXPECT_NEAR(sum / kSteps, 0.0, 4.0 * standard_error);
  EXPECT_NEAR(squares / kSteps, 1.0, 4.0 * std::sqrt(2.0) * standard_error);
  EXPECT_NEAR(lagged / kSteps, 0.0, 4.0 * standard_error);
}

// Derived: mean and variance of a Poisson count are its mean; Var(sample variance) ≈ (μ + 2μ²)/n.
TEST(Stream, DrawsPoissonCountsWithEqualMeanAndVariance) {
  constexpr int kDraws = 50'000;
  constexpr double kMean = 4.5;
  Stream stream(5, Purpose::kClutter, 0, 0);
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double count = stream.poisson(kMean);
    sum += count;
    squares += count * count;
  }
  const double mean = sum / kDraws;
  EXPECT_NEAR(mean, kMean, 4.0 * std::sqrt(kMean / kDraws));
  EXPECT_NEAR(squares / kDraws - mean * mean, kMean,
              4.0 * std::sqrt((kMean + 2.0 * kMean * kMean) / kDraws));
  EXPECT_EQ(stream.poisson(0.0), 0);
}

// Derived: Var t = ν/(ν − 2), kurtosis 3 + 6/(ν − 4): for ν = 10 the variance of t² is
// (4 − 1) (10/8)².
TEST(Stream, DrawsStudentsTWithItsVariance) {
  constexpr int kDraws = 200'000;
  constexpr double kDof = 10.0;
  constexpr double kVariance = kDof / (kDof - 2.0);
  Stream stream(5, Purpose::kMeasurementNoise, 1, 0);
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = stream.student_t(kDof);
    squares += x * x;
  }
  EXPECT_NEAR(squares / kDraws, kVariance, 4.0 * kVariance * std::sqrt(3.0 / kDraws));
}

}  // namespace
}  // namespace ghtrack

#include "tracker/filters/batch.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/tracker/filters/random_gains.hpp"
#include "tracker/filters/gain_filter.hpp"

namespace ghtrack {
namespace {

using Scalar = Eigen::Matrix<double, 1, 1>;

constexpr std::size_t kLanes = 1003;  // no multiple of any vector's length
constexpr int kSteps = 40;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

struct Lanes {
  std::vector<double> x = std::vector<double>(kLanes, 0.0);
  std::vector<double> v = x;
  std::vector<double> a = x;
};

/// Lanes and one filter for each, fed with the same measurements; every third may be missing.
void compare_bits(const Gains& gains, bool with_misses) {
  const double dt = 0.3;
  const BatchGains<double> batch(gains, dt);
  Lanes lanes;
  std::vector<GainFilter<1>> filters(kLanes, GainFilter<1>(gains, dt, {}));
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution missing(1.0 / 3.0);
  std::vector<double> z(kLanes);
  std::vector<double> used(kLanes, 1.0);
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      z[i] = 10.0 * normal(engine);
      if (with_misses) used[i] = missing(engine) ? 0.0 : 1.0;
      filters[i].predict(dt);
      if (used[i] != 0.0) filters[i].update(Scalar(z[i]));
    }
    const std::span<const double> mask = with_misses ? used : std::span<const double>{};
    if (gains.order == 2) {
      step_batch(batch, lanes.x, lanes.v, lanes.a, z, mask);
    } else {
      step_batch(batch, lanes.x, lanes.v, z, mask);
    }
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Kinematics<1>& state = filters[i].estimate();
    ASSERT_EQ(bits(lanes.x[i]), bits(state.position[0])) << i;
    ASSERT_EQ(bits(lanes.v[i]), bits(state.velocity[0])) << i;
    ASSERT_EQ(bits(lanes.a[i]), bits(state.acceleration[0])) << i;
  }
}

// Property: the bits of the scalar filter, on whatever instruction set was chosen.
TEST(Batch, GivesTheBitsOfTheScalarFilter) {
  std::mt19937_64 engine(1);
  for (int i = 0; i < 6; ++i) {
    const Gains gains = testing::random_stable_gains(1 + i % 2, 0.99, engine);
    compare_bits(gains, false);
    compare_bits(gains, true);
  }
}

// Derived: single precision differs from double precision by rounding alone.
TEST(Batch, InSinglePrecisionStaysWithinRounding) {
  const Gains gains = Gains::of_ghk(0.5, 0.2, 0.02);
  std::vector<float> x(9, 0.0F), v(9, 0.0F), a(9, 0.0F), z(9);
  std::vector<double> xd(9, 0.0), vd(9, 0.0), ad(9, 0.0), zd(9);
  for (int step = 0; step < 100; ++step) {
    for (std::size_t i = 0; i < z.size(); ++i) {
      zd[i] = static_cast<double>((step * 7 + static_cast<int>(i)) % 13);
      z[i] = static_cast<float>(zd[i]);
    }
    step_batch(BatchGains<float>(gains, 1.0), x, v, a, z, {});
    step_batch(BatchGains<double>(gains, 1.0), xd, vd, ad, zd, {});
  }
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], xd[i], 1e-4);
}

// Property: the sweep's sums are those of one filter at a time, to the last bit.
TEST(Batch, SweepsManyGainsLikeOneAfterTheOther) {
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  std::vector<Gains> gains;
  for (int i = 0; i < 45; ++i) gains.push_back(testing::random_stable_gains(1, 0.99, engine));
  std::vector<double> truth(200);
  std::vector<double> z(200);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    truth[i] = 0.4 * static_cast<double>(i);
    z[i] = truth[i] + normal(engine);
  }
  std::vector<double> errors(gains.size());
  sweep_gains(gains, 0.5, -1.0, 0.3, z, truth, errors);
  for (std::size_t j = 0; j < gains.size(); ++j) {
    Kinematics<1> guess;
    guess.position[0] = -1.0;
    guess.velocity[0] = 0.3;
    GainFilter<1> filter(gains[j], 0.5, guess);
    double sum = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      filter.predict(0.5);
      filter.update(Scalar(z[i]));
      const double error = filter.estimate().position[0] - truth[i];
      sum += error * error;
    }
    ASSERT_EQ(bits(errors[j]), bits(sum)) << j;
  }
}

// Property: a series in pieces has the bits of one filter that goes through it, whatever it
// forgets.
TEST(Batch, FiltersASeriesLikeOneFilterStepByStep) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution missing(0.05);
  const double dt = 0.3;
  std::vector<Gains> all = {Gains::of_gh(1.0, 1.0), Gains::of_gh(1e-4, 1e-9),
                            Gains::of_gh(2.5, 1.0), Gains::of_gh(0.0, 0.0)};
  for (int i = 0; i < 40; ++i) all.push_back(testing::random_stable_gains(1, 0.99, engine));
  for (int i = 0; i < 40; ++i) all.push_back(testing::random_stable_gains(2, 0.99, engine));
  for (const std::size_t n : {0, 1, 5, 999, 20'003}) {
    for (const Gains& gains : all) {
      std::vector<double> z(n);
      for (double& measured : z) {
        measured = missing(engine) ? std::numeric_limits<double>::quiet_NaN() : normal(engine);
      }
      const std::size_t row = gains.order == 2 ? 3 : 2;
      std::vector<double> estimates(row * n);
      Kinematics<1> now{Scalar(-0.5), Scalar(0.25), Scalar(gains.order == 2 ? 0.125 : 0.0)};
      filter_series(gains, dt, now, z, estimates);
      for (std::size_t i = 0; i < n; ++i) {
        const Kinematics<1> prior = extrapolated(now, dt);
        const Scalar residual(std::isnan(z[i]) ? 0.0 : z[i] - prior.position[0]);
        now = corrected<1>(prior, residual, gains, dt);
        if (!now.is_finite()) break;  // unstable gains
        const double* const said = &estimates[row * i];
        ASSERT_EQ(bits(said[0]), bits(now.position[0])) << gains.g << ' ' << n << ' ' << i;
        ASSERT_EQ(bits(said[1]), bits(now.velocity[0])) << gains.g << ' ' << i;
        if (gains.order == 2) {
          ASSERT_EQ(bits(said[2]), bits(now.acceleration[0])) << gains.g << ' ' << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ghtrack

// Hostile input to every filter: states stay finite, and every refusal is counted.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/effort.hpp"
#include "tracker/filters/filter.hpp"

namespace ghtrack {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_finite(const Filter& filter) {
  return estimate(filter).is_finite() && prior(filter).is_finite() &&
         position_sigma(filter).allFinite() && innovation_covariance(filter).allFinite();
}

std::vector<FilterConfig> configurations() {
  GhConfig fixed;
  fixed.design = gain_design::Manual<1>{.g = 0.4, .h = 0.1};
  GhConfig index;
  index.design = gain_design::TrackingIndex<1>{};
  index.huber = 1.345;
  GhkConfig memory;
  memory.design = gain_design::FadingMemory<2>{.theta = 0.7};
  GhkConfig triple;
  triple.design = gain_design::TrackingIndex<2>{};
  KalmanCvConfig cv;
  cv.huber = 2.0;
  return {fixed, index, memory, triple, cv, KalmanCaConfig{}};
}

/// Mostly harmless numbers; one in a hundred is not.
class Poison {
 public:
  explicit Poison(std::uint64_t seed) : engine_(seed) {}

  double time_step() {
    switch (rare()) {
      case 0:
        return 0.0;
      case 1:
        return -0.1;
      case 2:
        return kNaN;
      case 3:
        return kInfinity;
      case 4:
        return 1e-300;
      case 5:
        return 1e308;
      default:
        return 0.1;
    }
  }
  double measurement() {
    switch (rare()) {
      case 0:
        return kNaN;
      case 1:
        return kInfinity;
      case 2:
        return -kInfinity;
      case 3:
        return 1e308;
      case 4:
        return -1e308;
      case 5:
        return 5e-324;
      default:
        return static_cast<double>(engine_() % 1000) * 0.01;
    }
  }

 private:
  std::uint64_t rare() { return engine_() % 600; }
  std::mt19937_64 engine_;
};

// Property: ten million hostile steps, counted exactly, leave all numbers finite.
TEST(Robustness, SurvivesTenMillionHostileUpdates) {
  const auto all = configurations();
  const int rounds = testing::samples(10'000'000) / static_cast<int>(all.size()) + 1;
  for (const FilterConfig& config : all) {
    Filter filter = make_filter(config, 0.3, 0.1);
    Poison poison(17);
    Refusals expected;
    bool finite = true;
    for (int i = 0; i < rounds; ++i) {
      expected.times += !predict(filter, poison.time_step());
      const Eigen::Vector2d z(poison.measurement(), 1.0);
      expected.measurements += !update(filter, z);
      finite = finite && (i % 16 != 0 || is_finite(filter));
    }
    EXPECT_TRUE(finite && is_finite(filter)) << name(filter);
    EXPECT_EQ(refusals(filter).times, expected.times);
    EXPECT_EQ(refusals(filter).measurements, expected.measurements);
    EXPECT_GT(expected.times, rounds / 200);
    EXPECT_GT(expected.measurements, rounds / 300);
    EXPECT_LT(expected.measurements, rounds / 50) << name(filter);
  }
}

// Property: hostile measurement errors are refused as well.
TEST(Robustness, RefusesCovariancesThatAreNone) {
  for (const FilterConfig& config : configurations()) {
    Filter filter = make_filter(config, 0.3, 0.1);
    const Eigen::Vector2d z(1.0, 2.0);
    EXPECT_FALSE(update(filter, z, Eigen::Matrix2d::Constant(kNaN)));
    EXPECT_FALSE(is_started(filter));
    EXPECT_TRUE(update(filter, z));
    EXPECT_TRUE(predict(filter, 0.1));
    EXPECT_FALSE(update(filter, z, -Eigen::Matrix2d::Identity()));
    EXPECT_FALSE(update(filter, z, kInfinity * Eigen::Matrix2d::Identity()));
    EXPECT_EQ(refusals(filter).measurements, 3);
    EXPECT_TRUE(is_finite(filter));
  }
}

// Property: after poison the filter finds its way back to its target.
TEST(Robustness, RecoversAfterPoison) {
  for (const FilterConfig& config : configurations()) {
    Filter filter = make_filter(config, 0.3, 0.1);
    const auto truth = [](int step) { return Eigen::Vector2d(0.5 * step, 3.0 - 0.2 * step); };
    for (int step = 0; step < 2000; ++step) {
      predict(filter, step == 50 ? kNaN : 0.1);
      if (step == 50) predict(filter, 0.1);
      update(filter, step == 60   ? Eigen::Vector2d(kNaN, kNaN)
                     : step == 70 ? Eigen::Vector2d(1e12, -1e12)
                                  : truth(step));
    }
    EXPECT_LT((estimate(filter).position - truth(1999)).norm(), 0.01) << name(filter);
  }
}

}  // namespace
}  // namespace ghtrack

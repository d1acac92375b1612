#include "tracker/filters/gain_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/tracker/filters/random_gains.hpp"
#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/polynomial_memory.hpp"

namespace ghtrack {
namespace {

using Scalar = Eigen::Matrix<double, 1, 1>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

GainFilter<1> starting_filter(const Gains& gains, double dt = 1.0, double sigma = 1.0) {
  return {GainSchedule{.steady = gains, .interval = dt},
          ErrorModel{.sigma = sigma, .initial_speed = 30.0, .initial_acceleration = 20.0}};
}

// Derived: steady-state lag of a g-h filter behind acceleration a is (1 − g) a T² / h.
TEST(GainFilter, LagsAnAcceleratingTargetByTheClosedFormAmount) {
  const double g = 0.4;
  const double h = 0.1;
  const double dt = 0.5;
  const double a = 3.0;
  GainFilter<1> filter = starting_filter(Gains::of_gh(g, h), dt);
  double truth = 0.0;
  for (int step = 0; step < 300; ++step) {
    truth = 0.5 * a * std::pow(step * dt, 2);
    filter.predict(dt);
    filter.update(Scalar(truth));
  }
  EXPECT_NEAR(truth - filter.estimate().position[0], (1.0 - g) * a * dt * dt / h, 1e-6);
}

// Derived: a second-order polynomial is followed without any lag by three gains.
TEST(GainFilter, WithThreeGainsFollowsAParabolaFromTheThirdPointOn) {
  GainFilter<1> filter = starting_filter(Gains::of_ghk(0.5, 0.2, 0.02), 0.5);
  for (int step = 0; step < 50; ++step) {
    const double t = 0.5 * step;
    const double truth = 4.0 - 3.0 * t + 5.0 * t * t;
    filter.predict(0.5);
    filter.update(Scalar(truth));
    if (step < 2) continue;
    EXPECT_NEAR(filter.estimate().position[0], truth, 1e-9);
    EXPECT_NEAR(filter.estimate().velocity[0], -3.0 + 10.0 * t, 1e-9);
    EXPECT_NEAR(filter.estimate().acceleration[0], 10.0, 1e-9);
  }
}

// Derived: one point says nothing of the velocity; two points, however far apart, give the slope.
TEST(GainFilter, TakesItsFirstVelocityFromTwoPoints) {
  GainFilter<2> filter(GainSchedule{.steady = Gains::of_gh(0.2, 0.02), .interval = 1.0},
                       ErrorModel{.initial_speed = 30.0});
  filter.update(Eigen::Vector2d(5.0, 7.0));
  EXPECT_EQ(filter.estimate().position, Eigen::Vector2d(5.0, 7.0));
  EXPECT_EQ(filter.estimate().velocity, Eigen::Vector2d::Zero());
  filter.predict(1.0);
  filter.coast();
  filter.predict(0.5);
  EXPECT_EQ(filter.consecutive_misses(), 1);
  filter.update(Eigen::Vector2d(8.0, 4.0));
  EXPECT_EQ(filter.consecutive_misses(), 0);
  EXPECT_EQ(filter.estimate().position, Eigen::Vector2d(8.0, 4.0));
  EXPECT_EQ(filter.estimate().velocity, Eigen::Vector2d(2.0, -2.0));
}

// Derived: growing memory's 1-sigma error at each start-up step (Zarchan & Musoff).
TEST(GainFilter, PredictsTheGrowingMemoryErrorWhileItStarts) {
  for (int order = 0; order <= 2; ++order) {
    const Gains tiny{order, 1e-3, order >= 1 ? 1e-7 : 0.0, order >= 2 ? 1e-12 : 0.0};
    GainFilter<1> filter = starting_filter(tiny, 0.1, 2.0);
    for (int n = 1; n <= 40; ++n) {
      filter.predict(0.1);
      filter.update(Scalar(0.0));
      if (n <= order) continue;
      const auto expected = growing_memory_sigma(order, n, 2.0, 0.1);
      EXPECT_NEAR(filter.position_sigma()[0] / expected[0], 1.0, 1e-9) << order << " " << n;
      if (order >= 1) {
        EXPECT_NEAR(filter.velocity_sigma()[0] / expected[1], 1.0, 1e-8);
      }
    }
  }
}

// Derived: the variance reduction factors, for any stable gains.
TEST(GainFilter, PredictsTheVarianceReductionFactorsInTheSteadyState) {
  std::mt19937_64 engine(1);
  for (int i = 0; i < 300; ++i) {
    const Gains gains = testing::random_stable_gains(i % 3, 0.95, engine);
    const double dt = 0.2;
    const double sigma = 3.0;
    GainFilter<1> filter = starting_filter(gains, dt, sigma);
    for (int step = 0; step < 700; ++step) {
      filter.predict(dt);
      if (step + 1 < 700) filter.update(Scalar(0.0));
    }
    EXPECT_NEAR(filter.innovation_covariance()(0, 0) / innovation_variance(gains, sigma, dt), 1.0,
                1e-9);
    filter.update(Scalar(0.0));
    const double vrf = variance_reduction(gains, dt).x;
    EXPECT_NEAR(filter.position_sigma()[0] / (sigma * std::sqrt(vrf)), 1.0, 1e-9);
  }
}

// Derived: after m misses the position's variance is VRF_x + 2 m T cov + (m T)² VRF_v.
TEST(GainFilter, PredictsTheErrorAfterEachConsecutiveMiss) {
  const Gains gains = Gains::of_gh(0.3, 0.05);
  const double dt = 0.5;
  const VarianceReduction vrf = variance_reduction(gains, dt);
  GainFilter<1> filter = starting_filter(gains, dt, 2.0);
  for (int step = 0; step < 400; ++step) {
    filter.predict(dt);
    filter.update(Scalar(0.0));
  }
  for (int m = 1; m <= 10; ++m) {
    filter.predict(dt);
    filter.coast();
    const double t = m * dt;
    const double variance = 4.0 * (vrf.x + 2.0 * t * vrf.x_dx + t * t * vrf.dx);
    EXPECT_NEAR(filter.position_sigma()[0] / std::sqrt(variance), 1.0, 1e-9);
    EXPECT_EQ(filter.consecutive_misses(), m);
    EXPECT_FALSE(filter.residual().has_value());
  }
}

struct Spread {
  double measured = 0.0;
  double predicted = 0.0;
};

/// Mean squares of error and predicted error after uneven steps and misses, many tracks.
Spread spread_after_uneven_steps(GainSchedule schedule, int tracks) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> noise;
  std::uniform_real_distribution<double> step(0.3, 1.7);
  std::bernoulli_distribution missed(0.3);
  Spread spread;
  for (int track = 0; track < tracks; ++track) {
    GainFilter<1> filter(schedule, ErrorModel{.initial_speed = 1.0});
    filter.update(Scalar(noise(engine)));
    while (filter.updates() < 12) {
      filter.predict(step(engine));
      if (missed(engine)) {
        filter.coast();
      } else {
        filter.update(Scalar(noise(engine)));
      }
    }
    filter.predict(step(engine));
    spread.measured += std::pow(filter.estimate().position[0], 2) / tracks;
    spread.predicted += std::pow(filter.position_sigma()[0], 2) / tracks;
  }
  return spread;
}

// Derived: the predicted error is exact for any gains, steps and misses; the mean of n squares has
// the relative standard error √(2/n), more for a mixture: 5 of them at twice that.
TEST(GainFilter, PredictsItsErrorUnderUnevenStepsAndMisses) {
  const GainSchedule fixed{.steady = tracking_index_gains(1, 0.3), .interval = 1.0};
  GainSchedule elapsed = fixed;
  elapsed.irregular_time = IrregularTime::kGainsFromElapsed;
  elapsed.law = IndexLaw{0.3};
  GainSchedule memory = elapsed;
  memory.steady = fading_memory_gains(1, 0.7);
  memory.law = MemoryLaw{0.7};
  constexpr int kTracks = 20000;
  for (const GainSchedule& schedule : {fixed, elapsed, memory}) {
    const Spread spread = spread_after_uneven_steps(schedule, kTracks);
    EXPECT_NEAR(spread.measured / spread.predicted, 1.0, 10.0 * std::sqrt(2.0 / kTracks));
  }
}

// Derived: two equally good measurements at one instant count like their mean.
TEST(GainFilter, WeighsASecondSensorAtTheSameInstant) {
  GainFilter<1> filter = starting_filter(Gains::of_gh(0.2, 0.02));
  filter.update(Scalar(1.0));
  filter.update(Scalar(3.0));
  EXPECT_NEAR(filter.estimate().position[0], 2.0, 1e-15);
  EXPECT_EQ(filter.estimate().velocity[0], 0.0);
  EXPECT_NEAR(filter.position_sigma()[0], std::sqrt(0.5), 1e-15);
}

/// Filters with a schedule of every kind, for gains of every order.
std::vector<GainFilter<1>> filters_of_every_schedule() {
  std::vector<GainFilter<1>> all;
  for (const Gains& gains :
       {Gains::of_g(0.3), Gains::of_gh(0.3, 0.05), Gains::of_ghk(0.5, 0.15, 0.02)}) {
    const ErrorModel errors{.sigma = 2.0, .initial_speed = 30.0, .initial_acceleration = 20.0};
    for (const StartUp start_up : {StartUp::kGrowingMemory, StartUp::kTwoPoint, StartUp::kNone}) {
      for (const IrregularTime irregular :
           {IrregularTime::kFixedGains, IrregularTime::kGainsFromCovariance}) {
        all.emplace_back(GainSchedule{.steady = gains,
                                      .interval = 0.5,
                                      .start_up = start_up,
                                      .irregular_time = irregular},
                         errors);
      }
    }
    ErrorModel moving = errors;
    moving.process_intensity = 3.0;
    all.emplace_back(
        GainSchedule{.steady = gains, .interval = 0.5, .source = GainSource::kCovariance}, moving);
  }
  return all;
}

// Derived: before time has passed, n measurements of variance σ² are one of their mean, of variance
// σ²/n: at that instant and ever after, whatever the order and the start-up.
TEST(GainFilter, TakesMeasurementsOfItsFirstInstantForTheirMean) {
  const std::vector<double> first = {1.0, 3.0, 2.5, 7.0};
  for (const GainFilter<1>& waiting : filters_of_every_schedule()) {
    GainFilter<1> each = waiting, mean = waiting;
    for (const double z : first) each.update(Scalar(z));
    mean.update(Scalar(3.375), Scalar(4.0 / 4.0));
    for (int step = 0; step < 30; ++step) {
      ASSERT_NEAR(each.estimate().position[0], mean.estimate().position[0], 1e-11) << step;
      ASSERT_NEAR(each.estimate().velocity[0], mean.estimate().velocity[0], 1e-11) << step;
      ASSERT_NEAR(each.estimate().acceleration[0], mean.estimate().acceleration[0], 1e-10);
      ASSERT_NEAR(each.position_sigma()[0], mean.position_sigma()[0], 1e-11) << step;
      for (GainFilter<1>* filter : {&each, &mean}) {
        filter->predict(0.5);
        filter->update(Scalar(0.4 * step * step));
      }
    }
  }
}

// Property: at any age two measurements of one instant count inversely to their variances.
TEST(GainFilter, WeighsMeasurementsOfOneInstantByTheirVariances) {
  for (const GainFilter<1>& waiting : filters_of_every_schedule()) {
    for (const int age : {1, 2, 3, 4, 7, 60}) {
      const auto position_after = [&](double z1, double z2) {
        GainFilter<1> filter = waiting;
        for (int step = 1; step < age; ++step) {
          filter.update(Scalar(0.1 * step));
          filter.predict(0.5);
        }
        filter.update(Scalar(z1), Scalar(4.0));
        filter.update(Scalar(z2), Scalar(12.0));
        return filter.estimate().position[0];
      };
      const double none = position_after(0.0, 0.0);
      EXPECT_NEAR((position_after(1.0, 0.0) - none) / (position_after(0.0, 1.0) - none), 3.0, 1e-9)
          << waiting.gains_text() << ", age " << age;
    }
  }
}

// Property: a guess that is certain learns nothing from a measurement of its own instant.
TEST(GainFilter, BelievesACertainGuessAtItsOwnInstant) {
  GainFilter<1> filter(Gains::of_gh(0.5, 0.2), 1.0, {.position = Scalar(3.0)});
  EXPECT_TRUE(filter.update(Scalar(5.0)));
  EXPECT_EQ(filter.estimate().position[0], 3.0);
  EXPECT_EQ(filter.estimate().velocity[0], 0.0);
}

// Property: gains for one step are used for that step alone.
TEST(GainFilter, UsesOverridingGainsOnce) {
  GainFilter<1> filter(Gains::of_gh(0.8, 0.2), 1.0, {});
  filter.predict(1.0);
  filter.update(Scalar(1.0), Gains::of_gh(1.0, 0.01));
  EXPECT_EQ(filter.estimate().position[0], 1.0);
  EXPECT_EQ(filter.used_gains(), Gains::of_gh(1.0, 0.01));
  filter.predict(1.0);
  filter.update(Scalar(2.01));
  EXPECT_EQ(filter.used_gains(), Gains::of_gh(0.8, 0.2));
}

// Property: a step that cannot be used changes nothing but its counter.
TEST(GainFilter, RefusesAndCountsWhatItCannotUse) {
  GainFilter<1> filter = starting_filter(Gains::of_gh(0.2, 0.02));
  EXPECT_FALSE(filter.update(Scalar(kNaN)));
  EXPECT_FALSE(filter.is_started());
  filter.update(Scalar(1.0));
  filter.predict(1.0);
  filter.update(Scalar(2.0));
  const Kinematics<1> before = filter.estimate();
  for (const double dt : {0.0, -1.0, kNaN, kInfinity, -kInfinity, 1e300}) {
    EXPECT_FALSE(filter.predict(dt));
  }
  for (const double z : {kNaN, kInfinity, -kInfinity}) EXPECT_FALSE(filter.update(Scalar(z)));
  EXPECT_FALSE(filter.update(Scalar(1.0), Scalar(-1.0)));
  EXPECT_FALSE(filter.update(Scalar(1.0), Scalar(kNaN)));
  EXPECT_EQ(filter.refusals().times, 6);
  EXPECT_EQ(filter.refusals().measurements, 6);
  EXPECT_EQ(filter.estimate().position, before.position);
  EXPECT_EQ(filter.estimate().velocity, before.velocity);
}

// Derived: beyond c sigmas of the innovation, √(R / (1 − g)) for gains that are the best of some
// motion, the pull of a residual stays that of c sigmas (Huber 1964).
TEST(GainFilter, ShortensTheResidualOfAnOutlier) {
  GainFilter<1> filter(GainSchedule{.steady = Gains::of_gh(0.5, 0.1)}, ErrorModel{.huber = 1.345});
  for (int i = 0; i < 20; ++i) {
    filter.predict(1.0);
    filter.update(Scalar(0.0));
  }
  filter.predict(1.0);
  const double limit = 1.345 * std::sqrt(1.0 / (1.0 - 0.5));
  for (const double z : {0.9 * limit, 1.1 * limit, 1000.0}) {
    GainFilter<1> copy = filter;
    copy.update(Scalar(z));
    EXPECT_NEAR(copy.estimate().position[0], 0.5 * std::min(z, limit), 1e-9);
    EXPECT_EQ((*copy.residual())[0], z);
  }
}

// Property: the text is what a table shows.
TEST(GainFilter, WritesItsGainsBriefly) {
  EXPECT_EQ(starting_filter(Gains::of_gh(0.1, 0.005)).gains_text(), "g=0.1 h=0.005");
  EXPECT_EQ(starting_filter(Gains::of_ghk(1.0 / 3.0, 0.2, 1e-5)).gains_text(),
            "g=0.3333 h=0.2 k=1e-05");
  EXPECT_EQ(starting_filter(Gains::of_g(0.5)).name(), "order0");
}

}  // namespace
}  // namespace ghtrack

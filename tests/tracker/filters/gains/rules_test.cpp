#include "tracker/filters/gains/rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

constexpr ProcessModel kModels[] = {ProcessModel::kPiecewiseConstant, ProcessModel::kRandomWalk,
                                    ProcessModel::kWhiteNoise};

// Derived: the steady state of the Riccati recursion of the same model.
TEST(TrackingIndex, GivesTheGainsOfTheConvergedKalmanFilter) {
  const double sigma = 1.7;
  const double dt = 0.4;
  for (double index = 1e-3; index < 2e2; index *= 3.0) {
    for (int order = 0; order <= 2; ++order) {
      for (const ProcessModel model : kModels) {
        if (order != 1 && model == ProcessModel::kWhiteNoise) continue;
        // λ of order 2 counts changes of acceleration, λ of orders 0 and 1 accelerations.
        const double intensity = intensity_of_index(model, index, sigma, dt);
        const Gains expected = steady_kalman_gains(model, order, intensity, sigma, dt);
        const Gains found = tracking_index_gains(order, index, model);
        EXPECT_NEAR(found.g, expected.g, 1e-12) << index << " order " << order;
        EXPECT_NEAR(found.h, expected.h, 1e-12) << index << " order " << order;
        EXPECT_NEAR(found.k, expected.k, 1e-12) << index << " order " << order;
      }
    }
  }
}

// Property: what settled_prediction finds does not change in another step, in any units and from
// gains that hardly follow to gains that do nothing else.
TEST(SettledPrediction, StaysWhatItIs) {
  for (double index = 1e-6; index < 1e4; index *= 10.0) {
    for (int order = 0; order <= 2; ++order) {
      for (const double dt : {1e-3, 1.0, 3600.0}) {
        for (const double sigma : {1e-6, 1.0, 1e5}) {
          const double r = sigma * sigma;
          const AxisCovariance<double> q =
              process_noise(ProcessModel::kRandomWalk, order,
                            intensity_of_index(ProcessModel::kRandomWalk, index, sigma, dt), dt);
          const AxisCovariance<double> p = settled_prediction(q, order, r, dt);
          const double s = p.xx + r;
          AxisCovariance<double> next =
              extrapolated(corrected(p, {p.xx / s, p.xv / s, p.xa / s}, r), dt);
          next += q;
          EXPECT_NEAR(next.xx / p.xx, 1.0, 1e-8) << index << " order " << order;
          if (order >= 1) {
            EXPECT_NEAR(next.vv / p.vv, 1.0, 1e-8) << index << " order " << order;
          }
          if (order >= 2) {
            EXPECT_NEAR(next.aa / p.aa, 1.0, 1e-8) << index << " order " << order;
          }
        }
      }
    }
  }
}

// Property: every λ gives stable gains that grow with it, without a gap where Cardano's formula
// has no real root (λ > 20.785).
TEST(TrackingIndex, GivesStableGrowingGainsFromTinyToHuge) {
  for (int order = 0; order <= 2; ++order) {
    for (const ProcessModel model : kModels) {
      if (order != 1 && model == ProcessModel::kWhiteNoise) continue;
      double last = 0.0;
      for (double index = 1e-6; index <= 1.0001e6; index *= 1.3) {
        const Gains gains = tracking_index_gains(order, index, model);
        EXPECT_TRUE(is_stable(gains)) << index;
        EXPECT_GE(gains.g, last) << index;
        last = gains.g;
      }
    }
  }
}

// Derived: λ² = β² / (1 − α) (Kalata 1984).
TEST(TrackingIndex, IsImpliedByItsPair) {
  for (double index = 1e-6; index < 1e3; index *= 7.0) {
    EXPECT_NEAR(implied_tracking_index(tracking_index_gains(1, index)) / index, 1.0, 1e-10);
  }
}

// Derived: a random walk of the velocity leads to Benedict and Bordner's relation.
TEST(TrackingIndex, OfARandomWalkIsBenedictBordner) {
  for (double index = 1e-4; index < 1e3; index *= 5.0) {
    const Gains gains = tracking_index_gains(1, index, ProcessModel::kRandomWalk);
    EXPECT_NEAR(gains.h, gains.g * gains.g / (2.0 - gains.g), 1e-15);
    EXPECT_NEAR(gains.h / std::sqrt(1.0 - gains.g) / index, 1.0, 1e-9);
  }
}

/// Noise in the prediction plus μ times the energy of a velocity step.
double pair_cost(const Gains& q, double mu) {
  return variance_reduction(q, 1.0).prediction + mu * transient_energy(q, 1.0).velocity;
}
/// The same with an acceleration step.
double triple_cost(const Gains& q, double mu) {
  return variance_reduction(q, 1.0).prediction + mu * transient_energy(q, 1.0).acceleration;
}

// Derived: stationary and lower than its neighbours in every direction, μ = h² / (1 − g).
TEST(BenedictBordner, MinimisesNoiseAndVelocityStepsTogether) {
  for (const double g : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const Gains best = benedict_bordner_gains(g);
    const double mu = best.h * best.h / (1.0 - g);
    for (double angle = 0.0; angle < 6.28; angle += 0.2) {
      const Gains other = Gains::of_gh(best.g * (1.0 + 1e-3 * std::cos(angle)),
                                       best.h * (1.0 + 1e-3 * std::sin(angle)));
      EXPECT_LT(pair_cost(best, mu), pair_cost(other, mu)) << g << " " << angle;
    }
  }
}

// Derived: direct comparison; the optimal μ follows from λ² = (2k)² / (1 − g).
TEST(BenedictBordner, OfThirdOrderMinimisesNoiseAndAccelerationSteps) {
  for (const double g : {0.2, 0.4, 0.6, 0.8}) {
    const Gains best = third_order_benedict_bordner_gains(g);
    const double mu = 4.0 * best.k * best.k / (1.0 - g);
    for (double angle = 0.0; angle < 6.28; angle += 0.4) {
      for (double tilt = -1.4; tilt < 1.5; tilt += 0.4) {
        const double c = 1e-3 * std::cos(tilt);
        const Gains other = Gains::of_ghk(best.g * (1.0 + c * std::cos(angle)),
                                          best.h * (1.0 + c * std::sin(angle)),
                                          best.k * (1.0 + 1e-3 * std::sin(tilt)));
        EXPECT_LT(triple_cost(best, mu), triple_cost(other, mu)) << g;
      }
    }
    EXPECT_GT(triple_cost(polge_bhagavan_gains(g), mu), triple_cost(best, mu)) << g;
  }
}

// Derived: both lie on 2h = g (g + h + k) (Simpson 1963).
TEST(PolgeBhagavan, SharesALineWithTheExactOptimum) {
  for (const double g : {0.05, 0.35, 0.86, 0.985}) {
    for (const Gains& q : {polge_bhagavan_gains(g), third_order_benedict_bordner_gains(g)}) {
      EXPECT_NEAR(2.0 * q.h, q.g * (q.g + q.h + q.k), 1e-13);
    }
  }
}

double error_of_pair(double index, double deviation) {
  return predicted_rmse(tracking_index_gains(1, index), 1.0, 1.0, deviation);
}

// Derived: no other λ has a smaller error; λ and RMSE as tabulated after Blair (2008).
TEST(MaximumAcceleration, HasTheSmallestErrorOnKalatasCurve) {
  struct Row {
    double deviation, index, rmse;
  };
  for (const Row& row : {Row{0.01, 0.0424, 0.490}, Row{0.1, 0.265, 0.705}, Row{1.0, 1.677, 0.905},
                         Row{10.0, 11.73, 0.991}}) {
    const Gains best = maximum_acceleration_gains(row.deviation);
    const double index = implied_tracking_index(best);
    EXPECT_NEAR(index / row.index, 1.0, 2e-3);
    EXPECT_NEAR(predicted_rmse(best, 1.0, 1.0, row.deviation), row.rmse, 6e-4);
    for (const double factor : {0.5, 0.9, 0.99, 1.01, 1.1, 2.0}) {
      EXPECT_LT(error_of_pair(index, row.deviation), error_of_pair(index * factor, row.deviation));
    }
  }
}

// Derived: 1/n averages; two points fix a line, three a parabola.
TEST(GrowingMemory, PassesThroughTheFirstPoints) {
  EXPECT_EQ(growing_memory_gains(0, 4), Gains::of_g(0.25));
  EXPECT_EQ(growing_memory_gains(1, 2), Gains::of_gh(1.0, 1.0));
  EXPECT_EQ(growing_memory_gains(2, 3), Gains::of_ghk(1.0, 1.5, 0.5));
  EXPECT_EQ(start_up_gains(2, 1), (Gains{2, 1.0, 0.0, 0.0}));
  EXPECT_EQ(start_up_gains(2, 2), (Gains{2, 1.0, 1.0, 0.0}));
}

// Derived: the same acceleration gain Γ / T² under all three conventions.
TEST(Conventions, ScaleTheThirdGainByTwoAndFour) {
  const Gains gains = tracking_index_gains(2, 0.3);
  const double gamma = gains.h * gains.h / (2.0 * gains.g);  // optimal γ of the γ / T² form
  EXPECT_NEAR(k_from_gamma_over_t2(gamma), gains.k, 1e-15);
  EXPECT_NEAR(k_from_gamma_over_2t2(gains.h * gains.h / gains.g), gains.k, 1e-15);
}

// Property: arguments outside the stated range are refused.
TEST(GainRules, RefuseArgumentsOutsideTheirRange) {
  EXPECT_THROW(fading_memory_gains(1, 1.01), std::invalid_argument);
  EXPECT_THROW(fading_memory_gains(3, 0.5), std::invalid_argument);
  EXPECT_THROW(benedict_bordner_gains(0.0), std::invalid_argument);
  EXPECT_THROW(polge_bhagavan_gains(1.0), std::invalid_argument);
  EXPECT_THROW(growing_memory_gains(1, 0), std::invalid_argument);
  EXPECT_THROW(tracking_index_gains(1, -1.0), std::invalid_argument);
  EXPECT_THROW(tracking_index_gains(1, std::nan("")), std::invalid_argument);
  EXPECT_THROW(tracking_index_gains(2, 1.0, ProcessModel::kWhiteNoise), std::invalid_argument);
  EXPECT_THROW(maximum_acceleration_gains(0.0), std::invalid_argument);
}

}  // namespace
}  // namespace ghtrack

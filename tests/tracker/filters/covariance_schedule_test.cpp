// Gains that follow the predicted error are the Kalman filter's, from the first detection on.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tracker/filters/filter.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kSigma = 2.0;
constexpr double kStep = 0.5;
constexpr double kNoise = 0.7;

struct Twins {
  const char* name;
  FilterConfig designed;
  FilterConfig kalman;
};

Twins twins(ProcessModel model, FilterConfig kalman) {
  GhConfig designed;
  designed.design =
      gain_design::TrackingIndex<1>{.process_noise = kNoise, .index = std::nullopt, .model = model};
  return {"gh", designed, std::move(kalman)};
}

std::vector<Twins> all_twins() {
  KalmanCvConfig constant, walk, white;
  constant.model = process::PiecewiseConstant{.process_noise = kNoise};
  walk.model = process::RandomWalk{.process_noise = kNoise};
  // The design's noise is an acceleration at its step: σ_w² T is the spectral density.
  white.model = process::WhiteNoise<1>{.spectral_density = kNoise * kNoise * kStep};
  KalmanCaConfig third;
  third.model = process::PiecewiseConstant{.process_noise = kNoise};
  GhkConfig ghk;
  ghk.design = gain_design::TrackingIndex<2>{.process_noise = kNoise};
  return {twins(ProcessModel::kPiecewiseConstant, constant),
          twins(ProcessModel::kRandomWalk, walk),
          twins(ProcessModel::kWhiteNoise, white),
          {"ghk", ghk, third}};
}

// Derived: Kalman's gain is the one that minimises the error that the g-h filter computes for any
// gain; uneven times, misses and measurements of uneven quality included.
TEST(CovarianceSchedule, IsTheKalmanFilterOfTheSameProcessNoise) {
  for (const Twins& pair : all_twins()) {
    Filter designed = make_filter(pair.designed, kSigma, kStep);
    Filter kalman = make_filter(pair.kalman, kSigma, kStep);
    std::mt19937 random(8);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 300; ++i) {
      const double dt = kStep * (0.5 + unit(random));
      predict(designed, dt);
      predict(kalman, dt);
      const Eigen::Matrix2d r =
          kSigma * kSigma * (0.5 + unit(random)) * Eigen::Matrix2d::Identity();
      const double x = 3.0 * i + normal(random);
      const double y = normal(random);
      if (unit(random) < 0.2) {
        coast(designed);
        coast(kalman);
      } else {
        update(designed, Vector2d(x, y), r);
        update(kalman, Vector2d(x, y), r);
      }
      const double tolerance = 1e-9 * (1.0 + estimate(kalman).position.norm());
      ASSERT_LT((estimate(designed).position - estimate(kalman).position).norm(), tolerance)
          << pair.name << " " << i;
      ASSERT_TRUE(position_sigma(designed).isApprox(position_sigma(kalman), 1e-9));
    }
  }
}

// Derived: at the nominal step the gains settle at the designed ones.
TEST(CovarianceSchedule, SettlesAtTheDesignedGains) {
  for (const Twins& pair : all_twins()) {
    Filter filter = make_filter(pair.designed, kSigma, kStep);
    for (int i = 0; i < 500; ++i) {
      predict(filter, kStep);
      update(filter, Vector2d(i, -i));
    }
    const Gains used = std::get<GainFilter<2>>(filter).used_gains();
    const Gains steady = *steady_gains(filter);
    EXPECT_NEAR(used.g, steady.g, 1e-9);
    EXPECT_NEAR(used.h, steady.h, 1e-9);
    EXPECT_NEAR(used.k, steady.k, 1e-9);
  }
}

// Property: the design chooses; whoever fills in a table gets it.
TEST(CovarianceSchedule, IsTheDefaultWhereTheDesignSaysHowUncertainTheMotionIs) {
  GhConfig config;
  EXPECT_EQ(config.source(), GainSource::kTable);
  config.design = gain_design::TrackingIndex<1>{};
  EXPECT_EQ(config.source(), GainSource::kCovariance);
  config.start_up = StartUp::kTwoPoint;
  EXPECT_EQ(config.source(), GainSource::kTable);
}

}  // namespace
}  // namespace ghtrack

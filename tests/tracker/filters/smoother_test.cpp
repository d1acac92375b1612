#include "tracker/filters/smoother.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "tracker/filters/filter.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

/// Positions of a target that goes straight and shakes a little.
struct Journey {
  std::vector<Vector2d> truth;
  std::vector<TimedPosition> track;
};

Journey journey(double acceleration, double missed, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution misses(missed);
  Journey made;
  Vector2d position(0.0, 0.0), velocity(3.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const Vector2d push = acceleration * Vector2d(normal(random), normal(random));
    position += 0.5 * velocity + 0.125 * push;
    velocity += 0.5 * push;
    made.truth.push_back(position);
    TimedPosition moment{.time = 0.5 * i, .position = {}, .covariance = {}};
    moment.covariance = Eigen::Matrix2d::Identity();
    const Vector2d error(normal(random), normal(random));
    if (i == 0 || !misses(random)) moment.position = position + error;
    made.track.push_back(moment);
  }
  return made;
}

// Derived: of a linear motion the smoothed path is the least-squares solution of all measurements
// and all moves at once; here for positions and velocities on one axis by a dense solver.
TEST(Smoother, SolvesForTheWholePathAtOnce) {
  const double acceleration = 0.6;
  const Journey made = journey(acceleration, 0.2, 5);
  KalmanCvConfig config{.model = process::WhiteNoise<1>{.spectral_density = 0.18},
                        .initial_speed = 10.0};
  const std::vector<Smoothed> result = smoothed(config, 1.0, 0.5, made.track);

  const auto n = static_cast<Eigen::Index>(made.track.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * n);
  information(1, 1) += 1.0 / 100.0;
  Eigen::Matrix2d f, q;
  f << 1.0, 0.5, 0.0, 1.0;
  q << 0.125 / 3.0, 0.125, 0.125, 0.5;
  q *= 0.18;
  const Eigen::Matrix2d w = q.inverse();
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& moment = made.track[static_cast<std::size_t>(i)];
    if (moment.position) {
      information(2 * i, 2 * i) += 1.0;
      right[2 * i] += moment.position->x();
    }
    if (i + 1 == n) break;
    information.block<2, 2>(2 * i, 2 * i) += f.transpose() * w * f;
    information.block<2, 2>(2 * i + 2, 2 * i + 2) += w;
    information.block<2, 2>(2 * i, 2 * i + 2) -= f.transpose() * w;
    information.block<2, 2>(2 * i + 2, 2 * i) -= w * f;
  }
  const Eigen::MatrixXd covariance = information.inverse();
  const Eigen::VectorXd path = covariance * right;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Smoothed& moment = result[static_cast<std::size_t>(i)];
    EXPECT_NEAR(moment.state.position.x(), path[2 * i], 1e-6);
    EXPECT_NEAR(moment.state.velocity.x(), path[2 * i + 1], 1e-6);
    EXPECT_NEAR(moment.covariance(0, 0), covariance(2 * i, 2 * i), 1e-6);
  }
}

// Property: what was learned later helps, of every kind of filter; a lag of all moments is no
// limit, and none is the filter itself.
TEST(Smoother, IsBetterThanTheFilter) {
  GhConfig manual{.design = gain_design::Manual<1>{.g = 0.4, .h = 0.1}};
  GhkConfig third{.design = gain_design::TrackingIndex<2>{.process_noise = 0.3}};
  const std::vector<SingleFilterConfig> configs = {
      manual, third, KalmanCvConfig{.model = process::WhiteNoise<1>{.spectral_density = 0.2}},
      EkfConfig{.motion = CoordinatedTurn{.spectral_density = 0.2}},
      UkfConfig{.motion = CoordinatedTurn{.spectral_density = 0.2}}};
  for (const SingleFilterConfig& config : configs) {
    double causal = 0.0, lagged = 0.0, whole = 0.0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const Journey made = journey(0.6, 0.2, seed);
      const auto none = smoothed(config, 1.0, 0.5, made.track, 0);
      const auto some = smoothed(config, 1.0, 0.5, made.track, 4);
      const auto all = smoothed(config, 1.0, 0.5, made.track);
      const auto enough = smoothed(config, 1.0, 0.5, made.track, 1000);
      for (std::size_t i = 10; i < made.truth.size(); ++i) {
        causal += (none[i].state.position - made.truth[i]).squaredNorm();
        lagged += (some[i].state.position - made.truth[i]).squaredNorm();
        whole += (all[i].state.position - made.truth[i]).squaredNorm();
        EXPECT_EQ(all[i].state.position, enough[i].state.position);
      }
    }
    EXPECT_LT(lagged, 0.8 * causal);
    EXPECT_LT(whole, lagged);
  }
}

}  // namespace
}  // namespace ghtrack

#include "tracker/filters/imm_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "tracker/filters/filter.hpp"

namespace ghtrack {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

MotionFilter<2> polynomial(int order, double density) {
  return MotionFilter<2>({.motion = PolynomialMotion{.order = order,
                                                     .process_intensity = density,
                                                     .initial_acceleration = 5.0},
                          .initial_speed = 10.0});
}

// Derived: modes that are all alike are one filter, whatever the mixing.
TEST(ImmFilter, OfEqualModesIsTheFilterItself) {
  MotionFilter<2> single = polynomial(1, 0.5);
  ImmFilter<2> imm({{"a", polynomial(1, 0.5)}, {"b", polynomial(1, 0.5)}}, 0.2);
  for (int i = 0; i < 30; ++i) {
    const Vector2d z(3.0 * i, std::sin(0.7 * i));
    single.predict(1.0);
    single.update(z);
    imm.predict(1.0);
    imm.update(z);
    EXPECT_LT((imm.estimate().position - single.estimate().position).norm(), 1e-9);
    EXPECT_LT((imm.position_sigma() - single.position_sigma()).norm(), 1e-9);
    if (i > 0) {
      EXPECT_NEAR(imm.log_likelihood(), single.log_likelihood(), 1e-9);
    }
  }
}

// Derived: one cycle of two one-state-each modes by hand: Blom & Bar-Shalom's equations on one
// axis.
TEST(ImmFilter, MixesByTheBook) {
  const double p = 0.1, q[2] = {0.01, 4.0}, dt = 1.0;
  ImmFilter<2> imm({{"a", polynomial(1, q[0])}, {"b", polynomial(1, q[1])}}, p);
  Eigen::Vector2d x[2];
  Eigen::Matrix2d c[2], across[2];  // of this axis; of the other one, whose modes agree
  double mu[2] = {0.5, 0.5};
  Eigen::Matrix2d f;
  f << 1.0, dt, 0.0, 1.0;
  for (int i = 0; i < 12; ++i) {
    const double z = i < 6 ? 2.0 * i : 12.0 + 5.0 * (i - 6);
    if (i == 0) {
      imm.start({z, 0.0}, Matrix2d::Identity());
      for (int j = 0; j < 2; ++j) {
        x[j] = {z, 0.0};
        c[j] = across[j] = Vector2d(1.0, 100.0).asDiagonal();
      }
      continue;
    }
    imm.predict(dt);
    imm.update({z, 0.0}, Matrix2d::Identity());
    Eigen::Vector2d x0[2];
    Eigen::Matrix2d c0[2], across0[2];
    double arrived[2], likelihood[2];
    for (int j = 0; j < 2; ++j) {
      const double w[2] = {(j == 0 ? 1 - p : p) * mu[0], (j == 1 ? 1 - p : p) * mu[1]};
      arrived[j] = w[0] + w[1];
      x0[j] = (w[0] * x[0] + w[1] * x[1]) / arrived[j];
      c0[j].setZero();
      across0[j] = (w[0] * across[0] + w[1] * across[1]) / arrived[j];
      for (int k = 0; k < 2; ++k) {
        const Vector2d d = x[k] - x0[j];
        c0[j] += w[k] / arrived[j] * (c[k] + d * d.transpose());
      }
    }
    for (int j = 0; j < 2; ++j) {
      Eigen::Matrix2d noise;
      noise << dt * dt * dt / 3.0, dt * dt / 2.0, dt * dt / 2.0, dt;
      x[j] = f * x0[j];
      c[j] = f * c0[j] * f.transpose() + q[j] * noise;
      const double s = c[j](0, 0) + 1.0;
      const double r = z - x[j][0];
      // The other axis sees its prediction exactly: its likelihood differs by its S alone.
      across[j] = f * across0[j] * f.transpose() + q[j] * noise;
      const double s_across = across[j](0, 0) + 1.0;
      const Vector2d gain_across = across[j].col(0) / s_across;
      across[j] -= s_across * gain_across * gain_across.transpose();
      likelihood[j] = std::exp(-0.5 * r * r / s) / std::sqrt(s * s_across);
      const Vector2d gain = c[j].col(0) / s;
      x[j] += gain * r;
      c[j] -= s * gain * gain.transpose();
    }
    const double sum = arrived[0] * likelihood[0] + arrived[1] * likelihood[1];
    for (int j = 0; j < 2; ++j) mu[j] = arrived[j] * likelihood[j] / sum;
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR(imm.modes()[j].weight, mu[j], 1e-9) << i;
      EXPECT_NEAR(imm.modes()[j].filter.state()[0], x[j][0], 1e-9) << i;
    }
    EXPECT_NEAR(imm.estimate().position.x(), mu[0] * x[0][0] + mu[1] * x[1][0], 1e-9);
  }
}

// Property: a target that goes straight, turns and goes straight is followed by the interacting
// models better than by either of them, and on its straight parts nearly as by the steady one.
TEST(ImmFilter, FollowsManoeuvresAndRestsBetweenThem) {
  const FilterConfig steady = KalmanCvConfig{.model = process::WhiteNoise<1>{0.02}};
  const FilterConfig nimble = KalmanCvConfig{.model = process::WhiteNoise<1>{50.0}};
  ImmConfig imm;
  imm.filters["steady"] = std::get<KalmanCvConfig>(steady);
  imm.filters["nimble"] = std::get<KalmanCvConfig>(nimble);
  imm.switching = 0.03;
  ImmConfig turning = imm;
  turning.filters["nimble"] =
      EkfConfig{.motion = CoordinatedTurn{.spectral_density = 0.1, .turn_density = 0.05}};
  const auto rmse = [](const FilterConfig& config) {
    std::mt19937_64 random(2);
    std::normal_distribution<double> normal;
    double squares = 0.0;
    int count = 0;
    for (int track = 0; track < 40; ++track) {
      Filter filter = make_filter(config, 3.0, 1.0);
      Vector2d position(0.0, 0.0), velocity(20.0, 0.0);
      for (int i = 0; i < 120; ++i) {
        const double rate = i >= 50 && i < 65 ? 0.15 : 0.0;
        velocity = Eigen::Rotation2Dd(rate) * velocity;
        position += velocity;
        predict(filter, 1.0);
        update(filter, position + 3.0 * Vector2d(normal(random), normal(random)));
        if (i < 10) continue;
        squares += (estimate(filter).position - position).squaredNorm();
        ++count;
      }
    }
    return std::sqrt(squares / count);
  };
  const double best_single = std::min(rmse(steady), rmse(nimble));
  EXPECT_LT(rmse(imm), 0.9 * best_single);
  EXPECT_LT(rmse(turning), rmse(imm));
}

}  // namespace
}  // namespace ghtrack

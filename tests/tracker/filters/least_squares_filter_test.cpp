#include "tracker/filters/least_squares_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace ghtrack {
namespace {

using Scalar = Eigen::Matrix<double, 1, 1>;

/// Position and derivatives, at the last point, of the polynomial fitted to all points at once.
Eigen::Vector3d fit(const std::vector<double>& z, double dt, int order) {
  const auto n = static_cast<Eigen::Index>(z.size());
  Eigen::MatrixXd powers(n, order + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i - n + 1) * dt;
    for (int p = 0; p <= order; ++p) powers(i, p) = std::pow(t, p);
  }
  const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(z.data(), n);
  const Eigen::VectorXd c = powers.colPivHouseholderQr().solve(right);
  Eigen::Vector3d state = Eigen::Vector3d::Zero();
  state.head(order + 1) = c;
  state[2] *= 2.0;
  return state;
}

// Derived: the least-squares polynomial through all points, solved by QR.
TEST(LeastSquaresFilter, EqualsTheFitThroughAllPoints) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  const double dt = 0.2;
  for (int order = 0; order <= 2; ++order) {
    LeastSquaresFilter<1> filter(order, dt);
    std::vector<double> z;
    for (int n = 1; n <= 60; ++n) {
      z.push_back(3.0 + 2.0 * n * dt + normal(engine));
      filter.predict();
      filter.update(Scalar(z.back()));
      if (n <= order) continue;
      const Eigen::Vector3d expected = fit(z, dt, order);
      const Kinematics<1>& state = filter.estimate();
      EXPECT_NEAR(state.position[0], expected[0], 1e-9);
      EXPECT_NEAR(state.velocity[0], expected[1], 1e-9);
      EXPECT_NEAR(state.acceleration[0], expected[2], 1e-8);
    }
  }
}

// Property: after a reset nothing is left of the past.
TEST(LeastSquaresFilter, StartsAnewAfterAReset) {
  LeastSquaresFilter<2> filter(1, 1.0);
  LeastSquaresFilter<2> fresh = filter;
  for (int i = 0; i < 5; ++i) {
    filter.predict();
    filter.update({1.0 * i, 7.0});
  }
  filter.reset();
  EXPECT_TRUE(std::isinf(filter.errors()[0]));
  for (auto* each : {&filter, &fresh}) {
    each->predict();
    each->update({4.0, 5.0});
  }
  EXPECT_EQ(filter.estimate().velocity, fresh.estimate().velocity);
  EXPECT_EQ(filter.updates(), 1);
}

// Property: what cannot be used is refused and counted.
TEST(LeastSquaresFilter, RefusesWhatItCannotUse) {
  LeastSquaresFilter<1> filter(1, 1.0);
  EXPECT_FALSE(filter.update(Scalar(std::nan(""))));
  EXPECT_FALSE(filter.predict(-1.0));
  EXPECT_EQ(filter.refusals().measurements, 1);
  EXPECT_EQ(filter.refusals().times, 1);
  EXPECT_EQ(filter.updates(), 0);
}

}  // namespace
}  // namespace ghtrack

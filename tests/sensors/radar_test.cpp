#include "sensors/radar.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/portable_math.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

const Vec2 kSite(100.0, -50.0);

/// Mean and standard error of a sample.
class Mean {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  double value() const { return sum_ / count_; }
  double standard_error() const {
    return std::sqrt((squares_ / count_ - value() * value()) / count_);
  }

 private:
  double count_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

struct RadarCase {
  double range;
  double bearing_deg;
  double sigma_range;
  double sigma_bearing_deg;
};

class RadarConversion : public ::testing::TestWithParam<RadarCase> {};

// Derived: E[λ⁻¹ r u] is the true place, so the mean error is 0 within 4.5 standard errors, and
// with the covariance of the error given the measurement E[eᵀ R⁻¹ e] = 2 (Mo et al. 1998); its
// remaining dependence on the true range is of the order of (σ_r / r)².
TEST_P(RadarConversion, IsUnbiasedAndConsistent) {
  const RadarCase& c = GetParam();
  Radar radar;
  radar.sigma_range = c.sigma_range;
  radar.sigma_bearing_deg = c.sigma_bearing_deg;
  const portable::SinCos turn = portable::sin_cos(c.bearing_deg * portable::kDegree);
  const Vec2 truth = kSite + c.range * Vec2(turn.cos, turn.sin);
  Mean x, y, nees;
  Stream noise(1, Purpose::kMeasurementNoise, 0, 0);
  for (int i = 0; i < 40000; ++i) {
    Vec2 unit;
    unit.x() = noise.normal();
    unit.y() = noise.normal();
    const Detection seen = *radar.measure(truth, kSite, unit);
    const Vec2 error = seen.position - truth;
    x.add(error.x());
    y.add(error.y());
    nees.add(error.dot(seen.covariance.inverse() * error));
  }
  EXPECT_NEAR(x.value(), 0.0, 4.5 * x.standard_error());
  EXPECT_NEAR(y.value(), 0.0, 4.5 * y.standard_error());
  const double remainder = 6.0 * std::pow(c.sigma_range / c.range, 2);
  EXPECT_NEAR(nees.value(), 2.0, 4.5 * nees.standard_error() + remainder);
}

INSTANTIATE_TEST_SUITE_P(Ranges, RadarConversion,
                         ::testing::Values(RadarCase{100, 30, 1, 0.2}, RadarCase{1000, 120, 1, 0.2},
                                           RadarCase{5000, -100, 10, 2}, RadarCase{500, 45, 5, 10},
                                           RadarCase{1e5, 170, 50, 1.5},
                                           RadarCase{1000, -30, 1, 25}, RadarCase{50, 200, 2, 40}));

// Derived: for small noise the covariance becomes σ_r² along and (r σ_θ)² across the bearing.
TEST(Radar, HasTheCovarianceOfSmallErrors) {
  const PolarNoise noise{.range = 3.0, .bearing = 1e-3};
  const Detection seen = to_cartesian({.range = 2000.0, .direction = Vec2(0.6, 0.8)}, noise);
  const Vec2 along(0.6, 0.8);
  const Vec2 across(-0.8, 0.6);
  EXPECT_NEAR(along.dot(seen.covariance * along), 9.0, 1e-4);
  EXPECT_NEAR(across.dot(seen.covariance * across), 4.0, 1e-4);
  EXPECT_NEAR(along.dot(seen.covariance * across), 0.0, 1e-9);
}

// Derived: the biased conversion that it replaces falls short by λ = e^(−σ²/2).
TEST(Radar, UndoesTheShorteningOfThePlainConversion) {
  const PolarNoise noise{.range = 1.0, .bearing = 0.5};
  const Detection seen = to_cartesian({.range = 100.0, .direction = Vec2::UnitX()}, noise);
  EXPECT_NEAR(seen.position.x(), 100.0 * std::exp(0.125), 1e-9);
}

// Derived: constant errors of range and bearing move the place along and across.
TEST(Radar, CarriesItsBiases) {
  Radar radar;
  radar.sigma_bearing_deg = 1e-3;
  radar.bias_range = 10.0;
  radar.bias_bearing_deg = 90.0;
  const Detection seen = *radar.measure(kSite + Vec2(40.0, 0.0), kSite, Vec2::Zero());
  EXPECT_NEAR((seen.position - kSite - Vec2(0.0, 50.0)).norm(), 0.0, 1e-6);
}

// Derived: nothing lies in a direction from the place itself.
TEST(Radar, CannotMeasureWhatIsAtItsSite) {
  EXPECT_FALSE(Radar{}.measure(kSite, kSite, Vec2::Zero()).has_value());
  EXPECT_EQ(Radar{}.false_alarm(kSite, kSite).position, kSite);
}

// Derived: a sector from 80 to 100 degrees holds what lies straight above, up to its range.
TEST(Radar, SeesBetweenItsBearingsUpToItsRange) {
  Radar radar;
  radar.max_range = 100.0;
  radar.sector_deg = Vec2(80.0, 100.0);
  const FieldOfView view = radar.view(kSite);
  EXPECT_TRUE(contains(view, kSite + Vec2(0.0, 99.0)));
  EXPECT_TRUE(contains(view, kSite + Vec2(-17.0, 98.0)));
  EXPECT_FALSE(contains(view, kSite + Vec2(0.0, 101.0)));
  EXPECT_FALSE(contains(view, kSite + Vec2(20.0, 80.0)));
  EXPECT_FALSE(contains(view, kSite + Vec2(0.0, -50.0)));
  radar.sector_deg = Vec2(-170.0, 170.0);
  EXPECT_TRUE(contains(radar.view(kSite), kSite + Vec2(0.0, -50.0)));
  EXPECT_FALSE(contains(radar.view(kSite), kSite + Vec2(-50.0, 1.0)));
}

}  // namespace
}  // namespace ghtrack

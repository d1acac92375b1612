#include "scenes/schema/series.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ghtrack {
namespace {

// Derived: Labbe's gen_data adds a i²/2 to a rate that grows by a as well, so a = 9 acts as 27.
TEST(GeneratedSeries, IntegratesAnAccelerationTwiceIfAskedTo) {
  const GeneratedSeries series{
      .points = 20, .start = 10.0, .acceleration = 9.0, .motion = Motion::kIntegratedTwice};
  double rate = 0.0;
  for (int i = 0; i < series.points; ++i) {
    EXPECT_DOUBLE_EQ(series.truth(i, 1.0), 10.0 + 9.0 * i * i / 2.0 + rate * i);
    rate += 9.0;
  }
}

// Derived: the recurrence x += v dt, v += a dt of Labbe's train, whose first measurement follows
// the first step.
TEST(GeneratedSeries, StepsPositionBeforeRateIfAskedTo) {
  const GeneratedSeries series{.points = 100,
                               .first = 1,
                               .start = 23000.0,
                               .rate = 15.0,
                               .acceleration = 0.2,
                               .motion = Motion::kStepwise};
  const double dt = 0.5;
  double position = 23000.0;
  double rate = 15.0;
  for (int i = 0; i < series.points; ++i) {
    position += rate * dt;
    rate += 0.2 * dt;
    EXPECT_NEAR(series.truth(i, dt), position, 1e-9);
  }
}

// Derived: x(t) = 10 + 2t + 0.5 a t².
TEST(GeneratedSeries, FollowsAParabola) {
  const GeneratedSeries series{.start = 10.0, .rate = 2.0, .acceleration = 0.5};
  EXPECT_DOUBLE_EQ(series.truth(30, 0.5), 10.0 + 2.0 * 15.0 + 0.25 * 225.0);
}

}  // namespace
}  // namespace ghtrack

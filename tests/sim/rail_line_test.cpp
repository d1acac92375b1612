#include "sim/regimes/rail_line.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

// Derived: a quarter circle.
TEST(RailLine, TurnsByTheAngleOfACurve) {
  const RailLine track({Straight{50.0}, Curve{100.0, 90.0, {}, 0.0}}, Vec2(10.0, 5.0), 0.0);
  const TrackPoint end = track.at(track.length());
  EXPECT_NEAR(track.length(), 50.0 + 50.0 * portable::kPi, 1e-9);
  EXPECT_NEAR(end.position.x(), 10.0 + 50.0 + 100.0, 1e-9);
  EXPECT_NEAR(end.position.y(), 5.0 + 100.0, 1e-9);
  EXPECT_NEAR(end.heading, 0.5 * portable::kPi, 1e-12);
}

// Derived: to the right for a negative radius or a negative angle, to the left for both.
TEST(RailLine, TurnsToTheSideThatTheSignsSay) {
  const auto heading = [](double radius, double angle) {
    const RailLine track({Curve{radius, angle, {}, 0.0}}, Vec2::Zero(), 0.0);
    return track.at(track.length()).heading;
  };
  EXPECT_NEAR(heading(-300.0, 30.0), -portable::kPi / 6.0, 1e-12);
  EXPECT_NEAR(heading(300.0, -30.0), -portable::kPi / 6.0, 1e-12);
  EXPECT_NEAR(heading(300.0, 30.0), portable::kPi / 6.0, 1e-12);
}

// Derived: the power series of the Fresnel integrals: x = L (1 − θ²/10 + θ⁴/216 − …),
// y = L (θ/3 − θ³/42 + θ⁵/1320 − …) with θ = L / 2R.
TEST(RailLine, FollowsAClothoid) {
  const RailLine track({Clothoid{120.0, 600.0}}, Vec2::Zero(), 0.0);
  const TrackPoint end = track.at(120.0);
  const double theta = 0.1;
  EXPECT_NEAR(end.position.x(),
              120.0 * (1.0 - theta * theta / 10.0 + std::pow(theta, 4) / 216.0 -
                       std::pow(theta, 6) / 9360.0),
              1e-9);
  EXPECT_NEAR(end.position.y(),
              120.0 * (theta / 3.0 - std::pow(theta, 3) / 42.0 + std::pow(theta, 5) / 1320.0),
              1e-9);
  EXPECT_NEAR(end.heading, theta, 1e-12);
  EXPECT_NEAR(end.curvature, 0.0, 1e-12);  // the straight beyond
  EXPECT_NEAR(track.curvature(60.0), 0.5 / 600.0, 1e-12);
}

// Property: place, heading and, with transitions, curvature are continuous; the arc length is one.
TEST(RailLine, IsSmooth) {
  const RailLine track({Straight{40.0}, Curve{300.0, 30.0, {}, 60.0}, Curve{-200.0, {}, 80.0, 30.0},
                        Clothoid{50.0, 400.0}, Clothoid{50.0, {}}},
                       Vec2(3.0, 4.0), 0.7);
  TrackPoint before = track.at(-20.0);
  for (double s = -19.9; s < track.length() + 20.0; s += 0.1) {
    const TrackPoint now = track.at(s);
    EXPECT_NEAR((now.position - before.position).norm(), 0.1, 1e-6) << s;
    EXPECT_NEAR(now.heading - before.heading, 0.0, 0.1 / 200.0 + 1e-6) << s;
    EXPECT_NEAR(now.curvature, before.curvature, 0.1 / 200.0 / 30.0 + 1e-6) << s;
    before = now;
  }
}

// Property: straight before the beginning, straight beyond the end.
TEST(RailLine, GoesOnStraight) {
  const RailLine track({Curve{100.0, 90.0, {}, 0.0}}, Vec2::Zero(), 0.0);
  EXPECT_NEAR((track.at(-30.0).position - Vec2(-30.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((track.at(track.length() + 30.0).position - Vec2(100.0, 130.0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace ghtrack

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/portable_math.hpp"
#include "tests/sim/scenario.hpp"

// What the air does beyond one density and gusts that stay where they are.

namespace ghtrack {
namespace {

EnvironmentConfig standard_air() {
  EnvironmentConfig config;
  config.air.density = 1.225;
  config.air.atmosphere = Atmosphere::kStandard;
  return config;
}

// Derived: the table of ISO 2533.
TEST(Air, ThinsAsTheStandardAtmosphere) {
  const Environment environment(standard_air(), 1);
  EXPECT_NEAR(environment.air_density(0.0), 1.225, 1e-12);
  EXPECT_NEAR(environment.air_density(1000.0), 1.1117, 1e-4);
  EXPECT_NEAR(environment.air_density(5000.0), 0.7361, 1e-4);
  EXPECT_NEAR(environment.air_density(11'000.0), 0.3639, 1e-4);
  EXPECT_NEAR(environment.air_density(15'000.0), 0.1937, 1e-4);
  EXPECT_NEAR(environment.air_density(25'000.0), 3.9466e-2, 1e-5);
  EXPECT_NEAR(environment.air_density(32'000.0), 1.3225e-2, 1e-5);
  EXPECT_NEAR(environment.air_density(47'000.0), 1.4275e-3, 2e-6);
  EXPECT_NEAR(environment.air_density(51'000.0), 8.6160e-4, 2e-6);
  EnvironmentConfig uniform = standard_air();
  uniform.air.atmosphere = Atmosphere::kUniform;
  EXPECT_EQ(Environment(uniform, 1).air_density(5000.0), 1.225);
}

Balloon weather_balloon() {
  Balloon balloon;
  balloon.radius = 0.5;
  balloon.envelope_mass = 0.1;
  balloon.position = Vec2(0.0, 1.0);
  balloon.expands = true;
  return balloon;
}

// Derived: the volume goes as 1/ρ, so that the lift stays, (ρ₀ V₀ − m) g, and the balloon rises at
// v² = 2 × lift / (ρ C_d π r²): faster where the air is thin.
TEST(Air, LetsABalloonGrowAndRiseFaster) {
  WorldConfig config = world_of({target_of(weather_balloon())});
  config.environment = standard_air();
  World world(config, 1);
  const Environment environment(config.environment, 1);
  const TruthState state = state_at(world, 600.0);
  const double start = environment.air_density(1.0);
  const double density = environment.air_density(state.position.y());
  const double volume = 4.0 / 3.0 * portable::kPi * 0.125;
  const double lift = (start * volume - (0.1 + 0.1664 * volume)) * kStandardGravity;
  const double area = portable::kPi * 0.25 * std::pow(start / density, 2.0 / 3.0);
  EXPECT_GT(state.position.y(), 1500.0);
  EXPECT_NEAR(state.velocity.y(), std::sqrt(2.0 * lift / (density * 0.47 * area)), 1e-3);
}

// Derived: it bursts where ρ₀/ρ is the cube of the ratio of the radii, and its envelope falls at
// v² = 2 m g / (ρ C_d A).
TEST(Air, BurstsABalloonWhereItIsTooLarge) {
  Balloon balloon = weather_balloon();
  balloon.burst_radius = 0.51;
  balloon.fall_drag_area = 0.05;
  WorldConfig config = world_of({target_of(balloon)});
  config.environment = standard_air();
  config.record.events = true;
  World world(config, 1);
  const Environment environment(config.environment, 1);
  const TruthState state = state_at(world, 300.0);
  ASSERT_EQ(world.events().size(), 1u);
  const WorldEvent& burst = world.events()[0];
  EXPECT_EQ(burst.kind, EventKind::kBurst);
  EXPECT_NEAR(environment.air_density(1.0) / environment.air_density(burst.position.y()),
              std::pow(0.51 / 0.5, 3), 1e-5);
  const double density = environment.air_density(state.position.y());
  EXPECT_LT(state.position.y(), burst.position.y());
  EXPECT_NEAR(state.velocity.y(), -std::sqrt(2.0 * 0.1 * kStandardGravity / (density * 0.05)),
              1e-2);
}

// Derived: a light ball at rest begins to fall with (m − ρV) g / (m + ρV/2).
TEST(Air, LiftsLightBalls) {
  ThrownBall ball = plain_ball(Vec2(0.0, 100.0), Vec2::Zero());
  ball.radius = 0.2;
  ball.mass = 0.08;
  ball.buoyancy = true;
  World world(world_of({target_of(ball)}), 1);
  const double displaced = 1.2 * 4.0 / 3.0 * portable::kPi * 0.008;
  EXPECT_NEAR(state_at(world, 0.0).acceleration.y(),
              -(0.08 - displaced) / (0.08 + 0.5 * displaced) * kStandardGravity, 1e-12);
}

Wind carrying(const Vec2& mean, std::uint64_t seed) {
  WindConfig config;
  config.mean = mean;
  config.turbulence.model = Dryden{0.2, 10.0, {}};
  config.turbulence.carried = true;
  return Wind(config, 0.0, seed);
}

// Derived: Taylor's hypothesis: what is here now is at r + U t after the time t, whatever else
// moves; so an observer who drifts with the mean wind feels the same gust all the time.
TEST(CarriedTurbulence, IsFrozenIntoTheMeanWind) {
  const Vec2 mean(8.0, 6.0);
  const Wind wind = carrying(mean, 3);
  for (const double t : {0.5, 3.0, 20.0}) {
    for (const Vec2& place : {Vec2(0.0, 0.0), Vec2(-30.0, 12.5), Vec2(400.0, 90.0)}) {
      EXPECT_LT((wind.at(place + t * mean, 5.0 + t) - wind.at(place, 5.0)).norm(), 1e-7);
    }
  }
  EXPECT_GT((wind.at(Vec2(400.0, 0.0), 5.0) - wind.at(Vec2::Zero(), 5.0)).norm(), 1e-3);
}

struct Correlation {
  double along = 0.0;
  double across = 0.0;
};

/// Of the gusts at two places at two instants, over many seeds, divided by the variances that are
/// meant.
Correlation correlation(const Vec2& apart, double later) {
  constexpr int kSeeds = 4000;
  const double shape = 0.177 + 0.000823 * 10.0 / 0.3048;
  const double along_sigma = 0.2 * 10.0;
  const double across_sigma = along_sigma * std::pow(shape, 0.4);
  Correlation sum;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Wind wind = carrying(Vec2(10.0, 0.0), static_cast<std::uint64_t>(seed));
    const Vec2 here(99'900.0, 5.0);  // where the carried gusts have little past to be computed
    const Vec2 first = wind.at(here, 1.0) - Vec2(10.0, 0.0);
    const Vec2 second = wind.at(here + apart, 1.0 + later) - Vec2(10.0, 0.0);
    sum.along += first.x() * second.x() / (kSeeds * along_sigma * along_sigma);
    sum.across += first.y() * second.y() / (kSeeds * across_sigma * across_sigma);
  }
  return sum;
}

// Five standard errors of a correlation of 4000 pairs.
const double kBound = 5.0 * std::sqrt(2.0 / 4000.0);

// Derived: a fixed observer sees Dryden's autocorrelations, e^(−τ/T_u) with T_u = L_u/U and
// (1 − τ/2T_w) e^(−τ/T_w) with T_w = L_w/U; two on a line along the wind see at one instant what
// one sees after the time x/U.
TEST(CarriedTurbulence, HasDrydensCorrelationsInTimeAndAlongTheWind) {
  const double shape = 0.177 + 0.000823 * 10.0 / 0.3048;
  const double along_time = 10.0 / std::pow(shape, 1.2) / 10.0;
  const double across_time = 10.0 / 10.0;
  const auto expect = [&](const Correlation& found, double delay) {
    EXPECT_NEAR(found.along, std::exp(-delay / along_time), kBound);
    EXPECT_NEAR(found.across, (1.0 - 0.5 * delay / across_time) * std::exp(-delay / across_time),
                kBound);
  };
  expect(correlation(Vec2::Zero(), 0.0), 0.0);
  expect(correlation(Vec2::Zero(), 1.5), 1.5);
  expect(correlation(Vec2(-8.0, 0.0), 0.0), 0.8);
  expect(correlation(Vec2(8.0, 0.0), 0.8), 0.0);
}

// Property: across the wind each component has the reach of its own length scale: at 20 m, twice
// L_w and a third of L_u, the vertical gusts are strangers and the horizontal ones are not.
TEST(CarriedTurbulence, HasItsOwnScaleForEachComponent) {
  const Correlation found = correlation(Vec2(0.0, 20.0), 0.0);
  EXPECT_NEAR(found.across, 0.0, kBound);
  EXPECT_GT(found.along, 0.5);
}

}  // namespace
}  // namespace ghtrack

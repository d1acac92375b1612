#include "tools/metrics/switches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tools/metrics/trajectory_gospa.hpp"

namespace ghtrack {
namespace {

using Ids = std::vector<std::int64_t>;
using Matches = std::vector<PointMatch>;

// Derived: a first acquisition, a gap and a loss are free; a change of track costs 1.
TEST(SwitchCounter, ChargesChangesAndNothingElse) {
  SwitchCounter counter;
  EXPECT_EQ(counter.add(Ids{7}, Ids{}, Matches{}), 0.0);
  EXPECT_EQ(counter.add(Ids{7}, Ids{1, 2}, Matches{{0, 0, 0.1}}), 0.0);
  EXPECT_EQ(counter.add(Ids{7}, Ids{}, Matches{}), 0.0);
  EXPECT_EQ(counter.add(Ids{7}, Ids{1, 2}, Matches{{0, 0, 0.2}}), 0.0);
  EXPECT_EQ(counter.add(Ids{7}, Ids{1, 2}, Matches{{0, 1, 0.2}}), 1.0);
  EXPECT_EQ(counter.add(Ids{7, 8}, Ids{2, 5}, Matches{{0, 0, 0.1}, {1, 1, 0.1}}), 0.0);
  EXPECT_EQ(counter.add(Ids{}, Ids{}, Matches{}), 0.0);
}

// Derived: a track that goes to another object costs 1; two that swap cost 2, whatever their order.
TEST(SwitchCounter, CountsEveryObject) {
  SwitchCounter stolen;
  stolen.add(Ids{1, 2}, Ids{5}, Matches{{0, 0, 0.0}});
  EXPECT_EQ(stolen.add(Ids{1, 2}, Ids{5}, Matches{{1, 0, 0.0}}), 1.0);
  EXPECT_EQ(stolen.add(Ids{1, 2}, Ids{5, 6}, Matches{{0, 1, 0.0}, {1, 0, 0.0}}), 0.5);
  SwitchCounter swapped;
  swapped.add(Ids{1, 2}, Ids{5, 6}, Matches{{0, 0, 0.0}, {1, 1, 0.0}});
  EXPECT_EQ(swapped.add(Ids{1, 2}, Ids{6, 5}, Matches{{0, 0, 0.0}, {1, 1, 0.0}}), 2.0);
}

// Property: GOSPA's assignments with these switches cost at least as much as those that T-GOSPA
// chooses, because it could have chosen them.
TEST(SwitchCounter, BoundsTheTrajectoryMetricFromAbove) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> choose(0, 3);
  for (int run = 0; run < 200; ++run) {
    constexpr double kCutoff = 5.0;
    constexpr double kPenalty = 1.5;
    TrajectoryGospa metric({kCutoff, 2.0, kPenalty});
    SwitchCounter counter;
    double upper = 0.0;
    for (int k = 0; k < 6; ++k) {
      Ids truth, tracks;
      std::vector<Eigen::Vector2d> at, of;
      for (int object = 0; object < 3; ++object) {
        if (choose(random) == 0) continue;
        truth.push_back(object);
        at.emplace_back(10.0 * object, 0.0);
      }
      Ids names = {0, 1, 2};
      if (choose(random) == 0) std::swap(names[0], names[1]);
      for (int object = 0; object < 3; ++object) {
        if (choose(random) == 0) continue;
        tracks.push_back(names[static_cast<std::size_t>(object)]);
        of.emplace_back(10.0 * object, 1.0);
      }
      const GospaResult sets = gospa(at, of, {kCutoff, 2.0, 2.0});
      upper += std::pow(sets.gospa, 2.0) +
               std::pow(kPenalty, 2.0) * counter.add(truth, tracks, sets.matches);
      metric.add(truth, at, tracks, of);
    }
    EXPECT_LE(std::pow(metric.result(true)->tgospa, 2.0), upper + 1e-6);
  }
}

// Derived: (GOSPA^p + γ^p n)^(1/p), also where the powers themselves would overflow.
TEST(GospaWithSwitches, AddsThePowers) {
  EXPECT_NEAR(gospa_with_switches(3.0, 1.0, 4.0, 2.0), 5.0, 1e-12);
  EXPECT_NEAR(gospa_with_switches(3.0, 2.0, 4.0, 1.0), 11.0, 1e-12);
  EXPECT_NEAR(gospa_with_switches(0.0, 0.5, 4.0, 2.0), std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(gospa_with_switches(3e200, 1.0, 4e200, 2.0) / 5e200, 1.0, 1e-12);
  EXPECT_EQ(gospa_with_switches(0.0, 0.0, 4.0, 2.0), 0.0);
}

}  // namespace
}  // namespace ghtrack

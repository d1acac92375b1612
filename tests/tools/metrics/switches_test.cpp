#include "tools/metrics/switches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ghtrack {
namespace {

using Ids = std::vector<std::int64_t>;
using Matches = std::vector<PointMatch>;

// Derived: 1 for a change of track, 1/2 into a gap and 1/2 out of it, 0 for what appears.
TEST(SwitchCounter, ChargesChangesWholeAndGapsByHalves) {
  SwitchCounter counter;
  EXPECT_EQ(counter.add(Ids{7}, Ids{1, 2}, Matches{{0, 0, 0.1}}), 0.0);
  EXPECT_EQ(counter.add(Ids{7}, Ids{1, 2}, Matches{{0, 0, 0.2}}), 0.0);
  EXPECT_EQ(counter.add(Ids{7}, Ids{1, 2}, Matches{{0, 1, 0.2}}), 1.0);
  EXPECT_EQ(counter.add(Ids{7}, Ids{}, Matches{}), 0.5);
  EXPECT_EQ(counter.add(Ids{7, 8}, Ids{2, 5}, Matches{{0, 0, 0.1}, {1, 1, 0.1}}), 0.5);
  EXPECT_EQ(counter.add(Ids{8}, Ids{2}, Matches{{0, 0, 0.3}}), 1.0);
  EXPECT_EQ(counter.add(Ids{}, Ids{}, Matches{}), 0.0);
  EXPECT_EQ(counter.add(Ids{8}, Ids{9}, Matches{{0, 0, 0.3}}), 0.0);
}

// Property: a drop-out costs the same alone and beside another pair.
TEST(SwitchCounter, DoesNotAskWhoElseIsThere) {
  for (const bool other : {false, true}) {
    SwitchCounter counter;
    const Ids truth = other ? Ids{1, 2} : Ids{1};
    const Ids both = other ? Ids{11, 12} : Ids{11};
    const Matches together = other ? Matches{{0, 0, 0.0}, {1, 1, 0.0}} : Matches{{0, 0, 0.0}};
    const Ids one = other ? Ids{12} : Ids{};
    const Matches without = other ? Matches{{1, 0, 0.0}} : Matches{};
    counter.add(truth, both, together);
    double sum = counter.add(truth, one, without);
    sum += counter.add(truth, both, together);
    EXPECT_EQ(sum, 1.0);
  }
}

// Property: swapping two objects between two tracks is two switches, whatever the tracks' numbers.
TEST(SwitchCounter, CountsEveryObject) {
  SwitchCounter counter;
  counter.add(Ids{1, 2}, Ids{5, 6}, Matches{{0, 0, 0.0}, {1, 1, 0.0}});
  EXPECT_EQ(counter.add(Ids{1, 2}, Ids{6, 5}, Matches{{0, 0, 0.0}, {1, 1, 0.0}}), 2.0);
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

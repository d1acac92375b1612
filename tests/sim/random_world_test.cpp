#include "tests/sim/random_world.hpp"

#include <gtest/gtest.h>

#include "tests/effort.hpp"

namespace ghtrack {
namespace {

// Property: whatever a scene may say, the world neither aborts nor produces a number that is not
// finite. Debian's Box2D aborts on NaN, on bodies of no size and on much else. The program
// random_worlds tries as many as one likes.
TEST(RandomWorld, NeverFails) {
  for (int seed = 0; seed < testing::samples(300); ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_TRUE(run_random_world(seed).finite);
  }
}

}  // namespace
}  // namespace ghtrack

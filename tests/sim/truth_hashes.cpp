// Prints the hashes that determinism_test.cpp expects, for tools/check_determinism.

#include <cinttypes>
#include <cstdio>

#include "tests/sim/golden_worlds.hpp"

int main() {
  std::printf("busy %" PRIu64 "\n", ghtrack::truth_hash(ghtrack::busy_world(), 4.0, 30.0));
  std::printf("stormy %" PRIu64 "\n", ghtrack::truth_hash(ghtrack::stormy_world(), 6.0, 30.0));
}

// energy_worlds [N [FIRST]]: runs N random worlds of balls (10 000 unless told) from seed FIRST on
// for six seconds each, and tells in which energy grew, something sank into something else, rested
// with a velocity or an acceleration, or on nothing. The suite runs the first few.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>

#include "tests/sim/energy_world.hpp"

int main(int argc, char** argv) {
  const std::uint64_t count = argc > 1 ? std::stoull(argv[1]) : 10'000;
  const std::uint64_t first = argc > 2 ? std::stoull(argv[2]) : 0;
  std::uint64_t failures = 0;
  long missed = 0;
  double total = 0.0;
  double slowest = 0.0;
  double most = 0.0;
  double lowest = 0.0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    try {
      const ghtrack::EnergyRun run = ghtrack::run_energy_world(seed);
      const double gained = run.begun > 0.0 ? run.most_gained / run.begun : 0.0;  // none: no balls
      total += run.cpu_time;
      slowest = std::max(slowest, run.cpu_time);
      most = std::max(most, gained);
      lowest = std::min(lowest, run.lowest);
      missed += run.collisions_missed;
      const bool rests = run.most_unrest < ghtrack::kAtRest && run.afloat == 0;
      if (gained < 1e-7 && run.lowest > -1e-6 && rests) continue;
      std::printf(
          "seed %ju: gained %.2e of its energy, lowest gap %.2e m, missed %ld, unrest %.2e "
          "m/s², %d afloat\n",
          static_cast<std::uintmax_t>(seed), gained, run.lowest, run.collisions_missed,
          run.most_unrest, run.afloat);
      std::fflush(stdout);
    } catch (const std::exception& error) {
      std::printf("seed %ju: %s\n", static_cast<std::uintmax_t>(seed), error.what());
    }
    ++failures;
  }
  std::printf(
      "%ju worlds in %.1f s (slowest %.2f s), %ju failures, %ld collisions missed; most "
      "gained %.2e of the energy, lowest gap %.2e m\n",
      static_cast<std::uintmax_t>(count), total, slowest, static_cast<std::uintmax_t>(failures),
      missed, most, lowest);
  return failures == 0 ? 0 : 1;
}

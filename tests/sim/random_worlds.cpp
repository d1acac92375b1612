// random_worlds [N [FIRST]]: runs N random worlds (100 000 unless told) from seed FIRST on, and
// tells which took longest. The suite runs the first few hundred.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/random_world.hpp"

int main(int argc, char** argv) {
  const std::uint64_t count = argc > 1 ? std::stoull(argv[1]) : 100'000;
  const std::uint64_t first = argc > 2 ? std::stoull(argv[2]) : 0;
  std::vector<std::pair<double, std::uint64_t>> times;
  std::uint64_t failures = 0;
  long missed = 0;
  double total = 0.0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    if (seed % 1000 == 0) {
      std::fprintf(stderr, "\rseed %ju", static_cast<std::uintmax_t>(seed));
    }
    try {
      const ghtrack::RandomRun run = ghtrack::run_random_world(seed);
      times.emplace_back(run.cpu_time, seed);
      total += run.cpu_time;
      missed += run.collisions_missed;
      if (run.finite) continue;
      std::printf("seed %ju: not finite\n", static_cast<std::uintmax_t>(seed));
    } catch (const std::exception& error) {
      std::printf("seed %ju: %s\n", static_cast<std::uintmax_t>(seed), error.what());
    }
    ++failures;
  }
  std::fputc('\n', stderr);
  std::sort(times.rbegin(), times.rend());
  times.resize(std::min<std::size_t>(times.size(), 10));
  for (const auto& [time, seed] : times) {
    std::printf("seed %ju: %.3f s\n", static_cast<std::uintmax_t>(seed), time);
  }
  std::printf("%ju worlds in %.1f s, %ju failures, %ld collisions missed\n",
              static_cast<std::uintmax_t>(count), total, static_cast<std::uintmax_t>(failures),
              missed);
  return failures == 0 ? 0 : 1;
}

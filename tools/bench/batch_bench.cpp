#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <vector>

#include "tools/bench/measurements.hpp"
#include "tracker/filters/batch.hpp"

// The batch kernel beside the in-place stream bandwidth over the very same arrays. The two take
// turns, so that a machine that is busy or throttled slows both alike, and the least time of each
// counts.

namespace ghtrack::bench {
namespace {

constexpr int kTurns = 40;
// At least this much for each turn: long enough to time, short enough to escape interruptions.
constexpr std::size_t kBytesPerTurn = std::size_t{64} << 20;

#if defined(__x86_64__) && defined(__gnu_linux__)
#define GHTRACK_FOR_EACH_CPU __attribute__((target_clones("avx2", "default")))
#else
#define GHTRACK_FOR_EACH_CPU
#endif

// STREAM's scale (McCalpin 1995), in place as a filter works.

GHTRACK_FOR_EACH_CPU
void scale(double* a, std::size_t n, double factor) {
  for (std::size_t i = 0; i < n; ++i) a[i] *= factor;
}

GHTRACK_FOR_EACH_CPU
void scale(float* a, std::size_t n, float factor) {
  for (std::size_t i = 0; i < n; ++i) a[i] *= factor;
}

/// Two axes for each object, one array per quantity.
template <class Real, int Order>
struct Lanes {
  explicit Lanes(std::size_t objects)
      : x(2 * objects),
        v(2 * objects),
        a(Order == 2 ? 2 * objects : 0),
        z(measurements<Real>(2 * objects)) {}

  std::size_t bytes_per_step() const {
    return (2 * (x.size() + v.size() + a.size()) + z.size()) * sizeof(Real);
  }

  void step(const BatchGains<Real>& gains) {
    if constexpr (Order == 2) {
      step_batch(gains, x, v, a, z, {});
    } else {
      step_batch(gains, x, v, z);
    }
  }

  std::size_t bytes_per_stream() const {
    return 2 * (x.size() + v.size() + a.size() + z.size()) * sizeof(Real);
  }
  void stream(Real one) {
    for (std::vector<Real>* lanes : {&x, &v, &a, &z}) scale(lanes->data(), lanes->size(), one);
  }

  std::vector<Real> x, v, a, z;
};

/// The least time of one repetition.
class Stopwatch {
 public:
  explicit Stopwatch(std::size_t bytes_per_repetition)
      : bytes_(bytes_per_repetition),
        repetitions_(std::max<std::size_t>(1, kBytesPerTurn / bytes_)) {}

  template <class Work>
  double time(const Work& work) {
    using Clock = std::chrono::steady_clock;
    work();  // what fits a cache is in it from here on, whoever had the turn before
    const Clock::time_point begin = Clock::now();
    for (std::size_t i = 0; i < repetitions_; ++i) {
      work();
      benchmark::ClobberMemory();
    }
    const std::chrono::duration<double> elapsed = Clock::now() - begin;
    const double seconds = elapsed.count() / static_cast<double>(repetitions_);
    least_ = std::min(least_, seconds);
    return seconds;
  }
  double least() const { return least_; }
  double bytes_per_second() const { return static_cast<double>(bytes_) / least_; }

 private:
  std::size_t bytes_;
  std::size_t repetitions_;
  double least_ = std::numeric_limits<double>::infinity();
};

template <class Real, int Order>
void batch(benchmark::State& state) {
  const auto objects = static_cast<std::size_t>(state.range(0));
  Lanes<Real, Order> lanes(objects);
  const BatchGains<Real> gains(Order == 1 ? Gains::of_gh(0.4, 0.1) : Gains::of_ghk(0.4, 0.1, 0.01),
                               kStep);
  Real one = 1;  // not known to the compiler
  benchmark::DoNotOptimize(one);

  Stopwatch kernel(lanes.bytes_per_step());
  Stopwatch stream(lanes.bytes_per_stream());
  for (auto _ : state) {
    state.SetIterationTime(kernel.time([&] { lanes.step(gains); }));
    stream.time([&] { lanes.stream(one); });
  }
  state.counters["updates/s"] = static_cast<double>(objects) / kernel.least();
  state.counters["ns/update"] = kernel.least() / static_cast<double>(objects) * 1e9;
  state.counters["GB/s"] = kernel.bytes_per_second() * 1e-9;
  state.counters["stream_GB/s"] = stream.bytes_per_second() * 1e-9;
  state.counters["of_stream_%"] = 100.0 * kernel.bytes_per_second() / stream.bytes_per_second();
}

void from_cache_to_memory(benchmark::internal::Benchmark* sizes) {
  for (const std::int64_t objects : {1'000, 10'000, 100'000, 1'000'000, 10'000'000})
    sizes->Arg(objects);
  sizes->Iterations(kTurns)->UseManualTime()->Unit(benchmark::kMicrosecond);
}

BENCHMARK(batch<double, 1>)->Name("gh/batch/double")->Apply(from_cache_to_memory);
BENCHMARK(batch<float, 1>)->Name("gh/batch/float")->Apply(from_cache_to_memory);
BENCHMARK(batch<double, 2>)->Name("ghk/batch/double")->Apply(from_cache_to_memory);
BENCHMARK(batch<float, 2>)->Name("ghk/batch/float")->Apply(from_cache_to_memory);

}  // namespace
}  // namespace ghtrack::bench

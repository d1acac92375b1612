#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "tools/bench/measurements.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/kalman_filter.hpp"

// Objects on two axes, one after the other, as a tracker meets them.

namespace ghtrack::bench {
namespace {

/// The bare recurrence, as one writes it in an afternoon: no predicted error, no refusals.
class BareGhFilter {
 public:
  [[gnu::noinline]] void step(const double* z) {
    for (int axis = 0; axis < 2; ++axis) {
      const double predicted = x_[axis] + kStep * v_[axis];
      const double residual = z[axis] - predicted;
      x_[axis] = predicted + g_ * residual;
      v_[axis] += h_per_step_ * residual;
    }
  }

 private:
  double x_[2] = {}, v_[2] = {};
  double g_ = 0.4, h_per_step_ = 0.1 / kStep;
};

void step(BareGhFilter& filter, const double* z) { filter.step(z); }

template <class Filter>
void step(Filter& filter, const double* z) {
  filter.predict(kStep);
  filter.update(Eigen::Vector2d(z[0], z[1]));
}

template <class Filter>
void one_after_the_other(benchmark::State& state, const Filter& filter) {
  const auto objects = static_cast<std::size_t>(state.range(0));
  std::vector<Filter> filters(objects, filter);
  const std::vector<double> z = measurements<double>(2 * objects);
  for (auto _ : state) {
    for (std::size_t i = 0; i < objects; ++i) step(filters[i], &z[2 * i]);
    benchmark::ClobberMemory();
  }
  const double updates = static_cast<double>(objects);
  state.counters["updates/s"] =
      benchmark::Counter(updates, benchmark::Counter::kIsIterationInvariantRate);
}

void bare_gh(benchmark::State& state) { one_after_the_other(state, BareGhFilter{}); }

void gh(benchmark::State& state) {
  one_after_the_other(state, GainFilter<2>(Gains::of_gh(0.4, 0.1), kStep, {}));
}

void ghk(benchmark::State& state) {
  one_after_the_other(state, GainFilter<2>(Gains::of_ghk(0.4, 0.1, 0.01), kStep, {}));
}

void kalman_cv(benchmark::State& state) {
  one_after_the_other(state, KalmanFilter<1, 2>({.interval = kStep, .initial_speed = 30.0}));
}

BENCHMARK(bare_gh)->Name("gh/bare_recurrence")->Arg(1)->Arg(1'000)->Arg(10'000);
BENCHMARK(gh)->Name("gh/gain_filter")->Arg(1)->Arg(1'000)->Arg(10'000);
BENCHMARK(ghk)->Name("ghk/gain_filter")->Arg(1)->Arg(1'000)->Arg(10'000);
BENCHMARK(kalman_cv)->Name("kalman_cv/kalman_filter")->Arg(1)->Arg(1'000)->Arg(10'000);

}  // namespace
}  // namespace ghtrack::bench

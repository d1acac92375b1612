#include "tracker/filters/batch.hpp"

#include <algorithm>
#include <array>
#include <cassert>

// One copy of each kernel per instruction set, chosen by the loader. No copy may fuse a
// multiplication with an addition: -ffp-contract=off keeps the bits alike. 512-bit vectors are
// left out: they slow the core down for everything else.
#if defined(__x86_64__) && defined(__gnu_linux__)
#define GHTRACK_FOR_EACH_CPU __attribute__((target_clones("avx2", "default")))
#else
#define GHTRACK_FOR_EACH_CPU
#endif
#define GHTRACK_INLINE inline __attribute__((always_inline))

namespace ghtrack {
namespace {

// The additions of zero are those of an absent acceleration: they turn −0 into +0 as there.

template <class Real>
GHTRACK_INLINE void step_pairs(const BatchGains<Real> k, std::size_t n, Real* __restrict x,
                               Real* __restrict v, const Real* __restrict z,
                               const Real* __restrict used) {
  constexpr Real kZero = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Real predicted = x[i] + k.dt * v[i] + kZero;
    const Real residual = used ? used[i] * (z[i] - predicted) : z[i] - predicted;
    x[i] = predicted + k.g * residual;
    v[i] = v[i] + kZero + k.h_per_dt * residual;
  }
}

template <class Real>
GHTRACK_INLINE void step_triples(const BatchGains<Real> k, std::size_t n, Real* __restrict x,
                                 Real* __restrict v, Real* __restrict a, const Real* __restrict z,
                                 const Real* __restrict used) {
  for (std::size_t i = 0; i < n; ++i) {
    const Real predicted = x[i] + k.dt * v[i] + k.half_dt2 * a[i];
    const Real residual = used ? used[i] * (z[i] - predicted) : z[i] - predicted;
    x[i] = predicted + k.g * residual;
    v[i] = v[i] + k.dt * a[i] + k.h_per_dt * residual;
    a[i] = a[i] + k.k2_per_dt2 * residual;
  }
}

GHTRACK_FOR_EACH_CPU
void step_pairs_of_double(const BatchGains<double>& k, std::size_t n, double* x, double* v,
                          const double* z, const double* used) {
  used ? step_pairs(k, n, x, v, z, used)
       : step_pairs(k, n, x, v, z, static_cast<const double*>(nullptr));
}

GHTRACK_FOR_EACH_CPU
void step_pairs_of_float(const BatchGains<float>& k, std::size_t n, float* x, float* v,
                         const float* z, const float* used) {
  used ? step_pairs(k, n, x, v, z, used)
       : step_pairs(k, n, x, v, z, static_cast<const float*>(nullptr));
}

GHTRACK_FOR_EACH_CPU
void step_triples_of_double(const BatchGains<double>& k, std::size_t n, double* x, double* v,
                            double* a, const double* z, const double* used) {
  used ? step_triples(k, n, x, v, a, z, used)
       : step_triples(k, n, x, v, a, z, static_cast<const double*>(nullptr));
}

GHTRACK_FOR_EACH_CPU
void step_triples_of_float(const BatchGains<float>& k, std::size_t n, float* x, float* v, float* a,
                           const float* z, const float* used) {
  used ? step_triples(k, n, x, v, a, z, used)
       : step_triples(k, n, x, v, a, z, static_cast<const float*>(nullptr));
}

/// Gain pairs that are swept together: enough lanes to hide the latency of one filter's chain.
constexpr std::size_t kSweep = 32;

struct SweepBlock {
  std::array<double, kSweep> g{}, h_per_dt{}, x{}, v{}, error{};
};

GHTRACK_FOR_EACH_CPU
void sweep(SweepBlock& block, double dt, const double* z, const double* truth, std::size_t n) {
  constexpr double kZero = 0;
  SweepBlock b = block;
  for (std::size_t step = 0; step < n; ++step) {
    const double measured = z[step];
    const double true_position = truth[step];
    for (std::size_t i = 0; i < kSweep; ++i) {
      const double predicted = b.x[i] + dt * b.v[i] + kZero;
      const double residual = measured - predicted;
      b.x[i] = predicted + b.g[i] * residual;
      b.v[i] = b.v[i] + kZero + b.h_per_dt[i] * residual;
      const double error = b.x[i] - true_position;
      b.error[i] += error * error;
    }
  }
  block = b;
}

}  // namespace

void step_batch(const BatchGains<double>& gains, std::span<double> position,
                std::span<double> velocity, std::span<const double> z,
                std::span<const double> used) {
  assert(position.size() == velocity.size() && position.size() == z.size());
  step_pairs_of_double(gains, z.size(), position.data(), velocity.data(), z.data(),
                       used.empty() ? nullptr : used.data());
}

void step_batch(const BatchGains<float>& gains, std::span<float> position,
                std::span<float> velocity, std::span<const float> z, std::span<const float> used) {
  assert(position.size() == velocity.size() && position.size() == z.size());
  step_pairs_of_float(gains, z.size(), position.data(), velocity.data(), z.data(),
                      used.empty() ? nullptr : used.data());
}

void step_batch(const BatchGains<double>& gains, std::span<double> position,
                std::span<double> velocity, std::span<double> acceleration,
                std::span<const double> z, std::span<const double> used) {
  assert(position.size() == acceleration.size() && position.size() == z.size());
  step_triples_of_double(gains, z.size(), position.data(), velocity.data(), acceleration.data(),
                         z.data(), used.empty() ? nullptr : used.data());
}

void step_batch(const BatchGains<float>& gains, std::span<float> position,
                std::span<float> velocity, std::span<float> acceleration, std::span<const float> z,
                std::span<const float> used) {
  assert(position.size() == acceleration.size() && position.size() == z.size());
  step_triples_of_float(gains, z.size(), position.data(), velocity.data(), acceleration.data(),
                        z.data(), used.empty() ? nullptr : used.data());
}

void sweep_gains(std::span<const Gains> gains, double dt, double position, double velocity,
                 std::span<const double> z, std::span<const double> truth,
                 std::span<double> errors) {
  assert(z.size() == truth.size() && gains.size() == errors.size());
  for (std::size_t first = 0; first < gains.size(); first += kSweep) {
    const std::size_t count = std::min(kSweep, gains.size() - first);
    SweepBlock block;
    block.x.fill(position);
    block.v.fill(velocity);
    for (std::size_t i = 0; i < count; ++i) {
      block.g[i] = gains[first + i].g;
      block.h_per_dt[i] = gains[first + i].h / dt;
    }
    sweep(block, dt, z.data(), truth.data(), z.size());
    std::copy_n(block.error.begin(), count, errors.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace ghtrack

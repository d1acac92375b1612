#include "tracker/filters/batch.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "tracker/filters/gains/analysis.hpp"

// One copy of each kernel per instruction set, chosen by the loader. No copy may fuse a
// multiplication with an addition: -ffp-contract=off keeps the bits alike. 512-bit vectors are
// left out: they slow the core down for everything else. The loader chooses before ThreadSanitizer
// has started, whose calls GCC puts into the choice: with it there is one copy.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_THREAD__)
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

/// Filters that go through pieces of one series side by side.
constexpr std::size_t kPieces = 6;

/// One filter's state.
struct SeriesState {
  double x = 0.0, v = 0.0, a = 0.0;
};

/// @param order  1: without acceleration
template <int order>
GHTRACK_INLINE void step_one(const BatchGains<double>& k, double& x, double& v, double& a,
                             double measured) {
  const double predicted = order == 1 ? x + k.dt * v : x + k.dt * v + k.half_dt2 * a;
  const double residual = measured == measured ? measured - predicted : 0.0;
  x = predicted + k.g * residual;
  v = (order == 1 ? v : v + k.dt * a) + k.h_per_dt * residual;
  if constexpr (order == 2) a = a + k.k2_per_dt2 * residual;
}

/// Adding zero turns −0 into +0, as the term of an absent acceleration does.
template <int order>
GHTRACK_INLINE void keep(double* out, double x, double v, double a) {
  out[0] = order == 1 ? x + 0.0 : x;
  out[1] = order == 1 ? v + 0.0 : v;
  if constexpr (order == 2) out[2] = a;
}

struct SeriesPieces {
  std::array<double, kPieces> x{}, v{}, a{};
  std::array<const double*, kPieces> z{};
  std::array<double*, kPieces> out{};
};

/// @param is_kept  whether estimates are written, or only the state is brought on
template <int order, bool is_kept>
GHTRACK_INLINE void run_pieces(const BatchGains<double> k, SeriesPieces& pieces, std::size_t n) {
  SeriesPieces p = pieces;
  for (std::size_t step = 0; step < n; ++step) {
    for (std::size_t i = 0; i < kPieces; ++i) {
      step_one<order>(k, p.x[i], p.v[i], p.a[i], p.z[i][step]);
      if constexpr (is_kept) {
        keep<order>(p.out[i] + (order + 1) * step, p.x[i], p.v[i], p.a[i]);
      }
    }
  }
  pieces = p;
}

/// Filters on from a state until the estimates that are there already are met to the last bit.
template <int order>
void mend(const BatchGains<double>& k, SeriesState now, std::span<const double> z, double* out) {
  for (const double measured : z) {
    step_one<order>(k, now.x, now.v, now.a, measured);
    if (out[0] == now.x && out[1] == now.v && (order == 1 || out[2] == now.a)) return;
    keep<order>(out, now.x, now.v, now.a);
    out += order + 1;
  }
}

/// Steps in which a filter forgets its beginning to the last bit of a double; as good as never for
/// one that is not stable.
std::size_t memory_of(const Gains& gains) {
  constexpr double kLongest = 1e9;
  const double steps = is_stable(gains) ? settling_updates(gains, 1e-18) + 64.0 : kLongest;
  return static_cast<std::size_t>(std::min(steps, kLongest));
}

template <int order>
void filter_series(const Gains& gains, double dt, const SeriesState& start,
                   std::span<const double> z, std::span<double> estimates) {
  constexpr std::size_t kRow = order + 1;
  assert(estimates.size() == kRow * z.size());
  const BatchGains<double> k(gains, dt);
  const std::size_t memory = memory_of(gains);
  const std::size_t length = z.size() / kPieces;
  if (length / 2 < memory) {
    std::fill(estimates.begin(), estimates.end(), std::numeric_limits<double>::quiet_NaN());
    return mend<order>(k, start, z, estimates.data());
  }
  SeriesPieces pieces;
  for (std::size_t i = 1; i < kPieces; ++i) {
    pieces.z[i] = &z[i * length - memory];
    pieces.x[i] = std::isfinite(*pieces.z[i]) ? *pieces.z[i] : 0.0;
  }
  pieces.z[0] = pieces.z[1];  // the first one knows its beginning
  run_pieces<order, false>(k, pieces, memory);
  pieces.x[0] = start.x;
  pieces.v[0] = start.v;
  pieces.a[0] = start.a;
  for (std::size_t i = 0; i < kPieces; ++i) {
    pieces.z[i] = &z[i * length];
    pieces.out[i] = &estimates[kRow * i * length];
  }
  run_pieces<order, true>(k, pieces, length);

  const auto state_before = [&](std::size_t step) {
    const double* const end = &estimates[kRow * step];
    return order == 1 ? SeriesState{end[-2], end[-1], 0.0} : SeriesState{end[-3], end[-2], end[-1]};
  };
  for (std::size_t i = 1; i < kPieces; ++i) {
    mend<order>(k, state_before(i * length), z.subspan(i * length, length),
                &estimates[kRow * i * length]);
  }
  const std::size_t done = kPieces * length;
  std::fill(estimates.begin() + static_cast<std::ptrdiff_t>(kRow * done), estimates.end(),
            std::numeric_limits<double>::quiet_NaN());
  mend<order>(k, state_before(done), z.subspan(done), estimates.data() + kRow * done);
}

}  // namespace

void filter_series(const Gains& gains, double dt, const Kinematics<1>& start,
                   std::span<const double> z, std::span<double> estimates) {
  const SeriesState first{start.position[0], start.velocity[0], start.acceleration[0]};
  gains.order == 2 ? filter_series<2>(gains, dt, first, z, estimates)
                   : filter_series<1>(gains, dt, first, z, estimates);
}

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

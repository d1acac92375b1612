// The filter for the browser: what the page may call. Compiled for WebAssembly only, together with
// the sources that `ghtrack filter`, `ghtrack gains` and series scenes run; nothing is computed in
// JavaScript. One setting is tried at a time, and its answer stays in the module's memory until the
// next one.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tools/run/series.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

constexpr double kInterval = 1.0;
constexpr int kMostPoints = 100;

/// One quantity over the series, as the page reads it.
using Column = std::array<double, kMostPoints>;

struct Answer {
  Column truth, z, x_pred, dx_pred, residual, x, dx;
  double rmse, measurement_rmse, mean_absolute_innovation;
};

// NOLINTBEGIN: the module's memory is how WebAssembly returns more than a number.
Gains gains;
Answer answer;
// NOLINTEND

void follow(const GeneratedSeries& series, std::uint64_t seed, const Kinematics<1>& guess) {
  GainFilter<1> filter(gains, kInterval, guess);
  double squared = 0.0;
  double squared_noise = 0.0;
  double innovations = 0.0;
  std::size_t i = 0;
  for (const SeriesMeasurement& now : measure(series, kInterval, seed)) {
    filter.predict(kInterval);
    const Kinematics<1> prior = filter.estimate();
    filter.update(GainFilter<1>::Vector(now.z));
    const Kinematics<1>& posterior = filter.estimate();
    answer.truth[i] = *now.truth;
    answer.z[i] = now.z;
    answer.x_pred[i] = prior.position[0];
    answer.dx_pred[i] = prior.velocity[0];
    answer.residual[i] = now.z - prior.position[0];
    answer.x[i] = posterior.position[0];
    answer.dx[i] = posterior.velocity[0];
    squared += (answer.x[i] - *now.truth) * (answer.x[i] - *now.truth);
    squared_noise += (now.z - *now.truth) * (now.z - *now.truth);
    innovations += std::abs(answer.residual[i]);
    ++i;
  }
  const auto n = static_cast<double>(i);
  answer.rmse = std::sqrt(squared / n);
  answer.measurement_rmse = std::sqrt(squared_noise / n);
  answer.mean_absolute_innovation = innovations / n;
}

}  // namespace
}  // namespace ghtrack

using namespace ghtrack;

extern "C" {

/// Filters a series of up to 100 points, one second apart. A positive k makes it a g-h-k filter.
[[clang::export_name("run")]] void run_series(unsigned seed, int points, double start, double rate,
                                              double acceleration, double noise, double x0,
                                              double dx0, double g, double h, double k) {
  gains = k > 0.0 ? Gains::of_ghk(g, h, k) : Gains::of_gh(g, h);
  Kinematics<1> guess;
  guess.position[0] = x0;
  guess.velocity[0] = dx0;
  follow({.points = std::clamp(points, 1, kMostPoints),
          .start = start,
          .rate = rate,
          .acceleration = acceleration,
          .noise = noise},
         seed, guess);
}

[[clang::export_name("truth")]] const double* truth() { return answer.truth.data(); }
[[clang::export_name("z")]] const double* z() { return answer.z.data(); }
[[clang::export_name("x_pred")]] const double* x_pred() { return answer.x_pred.data(); }
[[clang::export_name("dx_pred")]] const double* dx_pred() { return answer.dx_pred.data(); }
[[clang::export_name("residual")]] const double* residual() { return answer.residual.data(); }
[[clang::export_name("x")]] const double* x() { return answer.x.data(); }
[[clang::export_name("dx")]] const double* dx() { return answer.dx.data(); }

[[clang::export_name("rmse")]] double rmse() { return answer.rmse; }
[[clang::export_name("measurement_rmse")]] double measurement_rmse() {
  return answer.measurement_rmse;
}
[[clang::export_name("mai")]] double mai() { return answer.mean_absolute_innovation; }

/// The broken stability condition as a C string; null for stable gains.
[[clang::export_name("violated")]] const char* violated() {
  const auto condition = violated_inequality(gains);
  return condition ? condition->data() : nullptr;
}
[[clang::export_name("damping")]] const char* damping_name() {
  return to_string(damping(gains)).data();
}
[[clang::export_name("damping_ratio")]] double ratio() { return damping_ratio(gains); }

// The rest is defined for stable gains only: ask violated() first.
[[clang::export_name("settling_updates")]] double settling() { return settling_updates(gains); }
[[clang::export_name("vrf_x")]] double vrf_x() { return variance_reduction(gains, kInterval).x; }
[[clang::export_name("vrf_dx")]] double vrf_dx() { return variance_reduction(gains, kInterval).dx; }
[[clang::export_name("vrf_prediction")]] double vrf_prediction() {
  return variance_reduction(gains, kInterval).prediction;
}
/// Behind the first derivative that the filter does not carry, if that is 1 and constant.
[[clang::export_name("lag_x")]] double lag_x() { return steady_lag(gains, kInterval, 1.0).x; }
[[clang::export_name("lag_prediction")]] double lag_prediction() {
  return steady_lag(gains, kInterval, 1.0).prediction;
}
[[clang::export_name("predicted_rmse")]] double predicted(double noise, double next_derivative) {
  return predicted_rmse(gains, noise, kInterval, next_derivative);
}

// The sources throw for arguments that the page does not pass, and the module has no unwinder: a
// throw ends the call with a WebAssembly trap, which JavaScript sees as a RuntimeError.
void* __cxa_allocate_exception(std::size_t) noexcept {  // NOLINT(bugprone-reserved-identifier)
  __builtin_trap();
}
[[noreturn]] void __cxa_throw(void*, void*, void (*)(void*)) {  // NOLINT
  __builtin_trap();
}

}  // extern "C"

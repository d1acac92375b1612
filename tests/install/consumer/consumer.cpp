#include <ghtrack/tracker/filters/gain_filter.hpp>

/// A ramp of slope 2 measured without error: the g-h filter must follow it without lag.
int main() {
  ghtrack::GainFilter<1> filter(ghtrack::Gains::of_gh(0.5, 0.2), 1.0, {});
  for (int step = 1; step <= 200; ++step) {
    filter.predict(1.0);
    filter.update(Eigen::Matrix<double, 1, 1>(2.0 * step));
  }
  const double error = filter.estimate().position[0] - 400.0;
  return error < 1e-9 && error > -1e-9 ? 0 : 1;
}

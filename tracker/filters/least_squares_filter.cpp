#include "tracker/filters/least_squares_filter.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace ghtrack {

template <int D>
LeastSquaresFilter<D>::LeastSquaresFilter(int order, double dt, double sigma,
                                          const Kinematics<D>& guess)
    : order_(order), dt_(dt), sigma_(sigma), guess_(guess) {
  if (order < 0 || order > 2) throw std::invalid_argument("order must be 0, 1 or 2");
  if (!(dt > 0.0) || !std::isfinite(dt)) throw std::invalid_argument("dt must be positive");
}

template <int D>
bool LeastSquaresFilter<D>::predict(double dt) {
  const Kinematics<D> next = extrapolated(estimate_, dt);
  if (!(dt > 0.0) || !std::isfinite(dt) || !next.is_finite()) {
    ++refusals_.times;
    return false;
  }
  prior_ = estimate_ = next;
  residual_.reset();
  return true;
}

template <int D>
bool LeastSquaresFilter<D>::update(const Vector& z) {
  const Gains gains = growing_memory_gains(order_, updates_ + 1);
  const Vector residual = z - estimate_.position;
  const Kinematics<D> next = corrected(estimate_, residual, gains, dt_);
  if (!residual.allFinite() || !next.is_finite()) {
    ++refusals_.measurements;
    return false;
  }
  prior_ = estimate_;
  estimate_ = next;
  residual_ = residual;
  used_ = gains;
  ++updates_;
  return true;
}

template <int D>
void LeastSquaresFilter<D>::reset() {
  *this = LeastSquaresFilter(order_, dt_, sigma_, guess_);
}

template <int D>
std::array<double, 3> LeastSquaresFilter<D>::errors() const {
  const double infinity = std::numeric_limits<double>::infinity();
  if (updates_ == 0) return {infinity, infinity, infinity};
  return growing_memory_sigma(order_, updates_, sigma_, dt_);
}

template class LeastSquaresFilter<1>;
template class LeastSquaresFilter<2>;
template class LeastSquaresFilter<3>;

}  // namespace ghtrack

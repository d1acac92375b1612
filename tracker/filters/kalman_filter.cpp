#include "tracker/filters/kalman_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/portable_math.hpp"
#include "tracker/filters/gain_filter.hpp"

namespace ghtrack {
namespace {

// The algebra is written by coefficients: loops of constant length run as fast as Eigen's
// expressions on blocks, which would take the compiler a minute for six kinds of state.

/// term(0) + … + term(D − 1).
template <int D, class Term>
double sum_over(const Term& term) {
  double sum = term(0);
  for (int m = 1; m < D; ++m) sum += term(m);
  return sum;
}

/// P ← F P Fᵀ for motion under constant velocity or acceleration.
template <int Order, int D, class Covariance>
void extrapolate(Covariance& p, double dt) {
  constexpr int kStates = (Order + 1) * D;
  const auto advance = [dt](auto&& derivative) {  // of one row or column, in place
    for (int axis = 0; axis < D; ++axis) derivative(axis) += dt * derivative(axis + D);
    if constexpr (Order == 2) {
      for (int axis = 0; axis < D; ++axis) {
        derivative(axis) += (0.5 * dt * dt) * derivative(axis + 2 * D);
        derivative(axis + D) += dt * derivative(axis + 2 * D);
      }
    }
  };
  for (int j = 0; j < kStates; ++j) advance([&](int i) -> double& { return p(i, j); });
  for (int i = 0; i < kStates; ++i) advance([&](int j) -> double& { return p(i, j); });
}

template <int Order, int D, class Covariance>
void add_on_each_axis(Covariance& p, const AxisCovariance<double>& q) {
  for (int i = 0; i < D; ++i) {
    const int v = i + D;
    p(i, i) += q.xx;
    p(i, v) += q.xv;
    p(v, i) += q.xv;
    p(v, v) += q.vv;
    if constexpr (Order == 2) {
      const int a = v + D;
      p(i, a) += q.xa;
      p(a, i) += q.xa;
      p(v, a) += q.va;
      p(a, v) += q.va;
      p(a, a) += q.aa;
    }
  }
}

template <class Matrix>
bool is_covariance(const Matrix& r) {
  return r.allFinite() && (r.diagonal().array() >= 0.0).all();
}

}  // namespace

template <int Order, int D>
KalmanFilter<Order, D>::KalmanFilter(const KalmanModel& model)
    : model_(model),
      steady_(steady_kalman_gains(model.process_model, Order, model.process_intensity, model.sigma,
                                  model.interval)) {}

template <int Order, int D>
KalmanFilter<Order, D>::KalmanFilter(const KalmanModel& model, const Kinematics<D>& guess,
                                     const Covariance& covariance)
    : KalmanFilter(model) {
  prior_ = estimate_ = guess;
  covariance_ = covariance;
  started_ = true;
}

template <int Order, int D>
std::string KalmanFilter<Order, D>::gains_text() const {
  return to_text(steady_);
}

template <int Order, int D>
bool KalmanFilter<Order, D>::start(const Vector& z, const Matrix& covariance) {
  if (!z.allFinite() || !is_covariance(covariance)) return refuse_measurement();
  prior_ = estimate_ = Kinematics<D>{.position = z};
  covariance_.setZero();
  covariance_.template topLeftCorner<D, D>() = covariance;
  covariance_.diagonal().template segment<D>(D).setConstant(model_.initial_speed *
                                                            model_.initial_speed);
  if constexpr (Order == 2) {
    covariance_.diagonal().template tail<D>().setConstant(model_.initial_acceleration *
                                                          model_.initial_acceleration);
  }
  residual_.reset();
  updates_ = 1;
  misses_ = 0;
  started_ = true;
  return true;
}

template <int Order, int D>
void KalmanFilter<Order, D>::start_from(const Kinematics<D>& guess) {
  start(guess.position);
  prior_ = estimate_ = guess;
  updates_ = 0;
}

template <int Order, int D>
bool KalmanFilter<Order, D>::predict(double dt) {
  const Kinematics<D> next = extrapolated(estimate_, dt);
  Covariance p = covariance_;
  extrapolate<Order, D>(p, dt);
  add_on_each_axis<Order, D>(
      p, process_noise(model_.process_model, Order, model_.process_intensity, dt, model_.renewal));
  if (!(dt > 0.0) || !std::isfinite(dt) || !next.is_finite() || !p.allFinite()) {
    ++refusals_.times;
    return false;
  }
  if (!started_) return true;
  prior_ = estimate_ = next;
  covariance_ = p;
  residual_.reset();
  return true;
}

template <int Order, int D>
bool KalmanFilter<Order, D>::update(const Vector& z, const Matrix& covariance) {
  if (!started_) return start(z, covariance);
  if (!z.allFinite() || !is_covariance(covariance)) return refuse_measurement();

  const Vector residual = z - estimate_.position;
  const Matrix predicted = covariance_.template topLeftCorner<D, D>();
  const Matrix s = predicted + covariance;
  const double determinant = s.determinant();
  if (!(determinant > 0.0) || !std::isfinite(determinant)) return refuse_measurement();
  const Matrix inverse = s.inverse();
  const double nis = residual.dot(inverse * residual);

  // A residual beyond the limit speaks of an outlier: its error is taken to be as much larger as
  // it takes for the pull of the limit itself (Huber 1964). It speaks of nothing before all
  // derivatives are known: a target may be much faster than one is taken to be at first sight.
  const bool is_settled = updates_ > Order;
  const double doubt = is_settled ? std::max(1.0, std::sqrt(nis) / model_.huber) : 1.0;
  const Matrix r = doubt > 1.0 ? Matrix(doubt * s - predicted) : covariance;
  const Matrix weight = inverse / doubt;
  Eigen::Matrix<double, kStates, D> gain;
  Eigen::Matrix<double, kStates, D> weighted;  // K R
  Eigen::Matrix<double, kStates, 1> change;
  for (int i = 0; i < kStates; ++i) {
    for (int j = 0; j < D; ++j) {
      gain(i, j) = sum_over<D>([&](int m) { return covariance_(i, m) * weight(m, j); });
    }
    for (int j = 0; j < D; ++j) {
      weighted(i, j) = sum_over<D>([&](int m) { return gain(i, m) * r(m, j); });
    }
    change[i] = sum_over<D>([&](int m) { return gain(i, m) * residual[m]; });
  }
  Kinematics<D> next = estimate_;
  for (int axis = 0; axis < D; ++axis) {
    next.position[axis] += change[axis];
    next.velocity[axis] += change[axis + D];
    if constexpr (Order == 2) next.acceleration[axis] += change[axis + 2 * D];
  }

  Covariance half;  // (I − K H) P, then times (I − K H)ᵀ, then + K R Kᵀ
  Covariance p;
  for (int j = 0; j < kStates; ++j) {
    for (int i = 0; i < kStates; ++i) {
      half(i, j) =
          covariance_(i, j) - sum_over<D>([&](int m) { return gain(i, m) * covariance_(m, j); });
    }
  }
  for (int j = 0; j < kStates; ++j) {
    for (int i = 0; i < kStates; ++i) {
      p(i, j) = half(i, j) - sum_over<D>([&](int m) { return half(i, m) * gain(j, m); });
      p(i, j) += sum_over<D>([&](int m) { return weighted(i, m) * gain(j, m); });
    }
  }
  for (int j = 0; j < kStates; ++j) {
    for (int i = 0; i < j; ++i) p(i, j) = p(j, i) = 0.5 * (p(i, j) + p(j, i));
  }
  if (!std::isfinite(nis) || !next.is_finite() || !p.allFinite()) return refuse_measurement();

  prior_ = estimate_;
  estimate_ = next;
  covariance_ = p;
  residual_ = residual;
  nis_ = nis;
  determinant_ = determinant;
  misses_ = 0;
  ++updates_;
  return true;
}

template <int Order, int D>
double KalmanFilter<Order, D>::log_likelihood() const {
  return -0.5 * (nis_ + portable::log(determinant_) + D * portable::log(2.0 * std::numbers::pi));
}

template <int Order, int D>
void KalmanFilter<Order, D>::coast() {
  residual_.reset();
  ++misses_;
}

template <int Order, int D>
void KalmanFilter<Order, D>::adopt(const Knowledge<D>& known) {
  const auto derivative = [&](int i) { return i * D; };
  const auto set_pair = [&](int i, int j, const Eigen::Array<double, D, 1>& value) {
    for (int axis = 0; axis < D; ++axis) {
      covariance_(derivative(i) + axis, derivative(j) + axis) = value[axis];
      covariance_(derivative(j) + axis, derivative(i) + axis) = value[axis];
    }
  };
  const auto unknown = [](double sigma) {
    return Eigen::Array<double, D, 1>::Constant(sigma * sigma).eval();
  };
  estimate_ = {.position = known.state.position};
  covariance_.setZero();
  set_pair(0, 0, known.covariance.xx);
  set_pair(1, 1, unknown(model_.initial_speed));
  if constexpr (Order == 2) set_pair(2, 2, unknown(model_.initial_acceleration));
  if (known.order >= 1) {
    estimate_.velocity = known.state.velocity;
    set_pair(0, 1, known.covariance.xv);
    set_pair(1, 1, known.covariance.vv);
  }
  if constexpr (Order == 2) {
    if (known.order >= 2) {
      estimate_.acceleration = known.state.acceleration;
      set_pair(0, 2, known.covariance.xa);
      set_pair(1, 2, known.covariance.va);
      set_pair(2, 2, known.covariance.aa);
    }
  }
  prior_ = estimate_;
}

template <int Order, int D>
Knowledge<D> KalmanFilter<Order, D>::knowledge() const {
  using Axes = Eigen::Array<double, D, 1>;
  const auto pair = [&](int i, int j) {
    Axes values;
    for (int axis = 0; axis < D; ++axis) values[axis] = covariance_(i * D + axis, j * D + axis);
    return values;
  };
  Knowledge<D> known{Order, estimate_, {pair(0, 0), pair(0, 1), {}, pair(1, 1), {}, {}}};
  if constexpr (Order == 2) {
    known.covariance.xa = pair(0, 2);
    known.covariance.va = pair(1, 2);
    known.covariance.aa = pair(2, 2);
  }
  return known;
}

template <int Order, int D>
auto KalmanFilter<Order, D>::position_sigma() const -> Vector {
  return covariance_.diagonal().template head<D>().cwiseMax(0.0).cwiseSqrt();
}

template <int Order, int D>
auto KalmanFilter<Order, D>::velocity_sigma() const -> Vector {
  return covariance_.diagonal().template segment<D>(D).cwiseMax(0.0).cwiseSqrt();
}

template <int Order, int D>
auto KalmanFilter<Order, D>::innovation_covariance(const Matrix& measurement) const -> Matrix {
  return measurement + covariance_.template topLeftCorner<D, D>();
}

template <int Order, int D>
bool KalmanFilter<Order, D>::refuse_measurement() {
  ++refusals_.measurements;
  return false;
}

template class KalmanFilter<1, 1>;
template class KalmanFilter<1, 2>;
template class KalmanFilter<1, 3>;
template class KalmanFilter<2, 1>;
template class KalmanFilter<2, 2>;
template class KalmanFilter<2, 3>;

}  // namespace ghtrack

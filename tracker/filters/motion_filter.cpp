#include "tracker/filters/motion_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <type_traits>

#include "sim/portable_math.hpp"
#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/carried.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/small_matrices.hpp"

namespace ghtrack {
namespace {

using Cross = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 3>;
using Points = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 12>;

/// The gains of the linear filter that this one is on a straight path.
Gains steady_gains_of(const MotionModel& model) {
  struct Steady {
    const MotionModel& model;
    Gains white(double density) const {
      return steady_kalman_gains(ProcessModel::kWhiteNoise, 1, density, model.sigma,
                                 model.interval);
    }
    Gains operator()(const PolynomialMotion& m) const {
      if (m.process_intensity > 0.0) {
        return steady_kalman_gains(m.process_model, m.order, m.process_intensity, model.sigma,
                                   model.interval);
      }
      const double t = model.interval;
      const double r = model.sigma * model.sigma;
      const AxisCovariance<double> p = settled_prediction(m.implied.over(t), m.order, r, t);
      const double s = p.xx + r;
      return {m.order, p.xx / s, t * p.xv / s, 0.5 * t * t * p.xa / s};
    }
    Gains operator()(const CoordinatedTurn& m) const { return white(m.spectral_density); }
    Gains operator()(const Ballistic& m) const { return white(m.spectral_density); }
  };
  return std::visit(Steady{model}, model.motion);
}

/// The points of the unscented transform, column by column.
Points points_of(const MotionState& x, const MotionCovariance& p) {
  const Eigen::Index n = x.size();
  const MotionCovariance scaled = static_cast<double>(n) * p;
  const MotionCovariance root = lower_root(scaled);
  Points points(n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    points.col(i) = x + root.col(i);
    points.col(n + i) = x - root.col(i);
  }
  return points;
}

/// ∂ moved / ∂ state by central differences, in steps that are small against the errors.
MotionCovariance derivative(const TargetMotion& motion, const MotionState& x,
                            const MotionCovariance& p, double dt) {
  const Eigen::Index n = x.size();
  MotionCovariance f(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!needs_plane(motion)) {
      f.col(i) = moved(motion, MotionState::Unit(n, i), dt);
      continue;
    }
    const double step = std::max(1e-3 * std::sqrt(std::max(p(i, i), 0.0)), 1e-7);
    MotionState above = x, below = x;
    above[i] += step;
    below[i] -= step;
    f.col(i) = (moved(motion, above, dt) - moved(motion, below, dt)) / (2.0 * step);
  }
  return f;
}

}  // namespace

Carried carried(const TargetMotion& motion, Propagation propagation, const MotionState& x,
                const MotionCovariance& p, double dt) {
  Carried next;
  if (!needs_plane(motion) || propagation == Propagation::kExtended) {
    const MotionCovariance f = derivative(motion, x, p, dt);
    next.x = moved(motion, x, dt);
    next.cross = p.lazyProduct(f.transpose());
    next.p = f.lazyProduct(next.cross);
  } else {
    const Points points = points_of(x, p);
    const double weight = 1.0 / static_cast<double>(points.cols());
    Points later = points;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      later.col(i) = moved(motion, points.col(i), dt);
    }
    next.x = later.rowwise().mean();
    later.colwise() -= next.x;
    next.p = weight * later.lazyProduct(later.transpose());
    const Points now = points.colwise() - x;
    next.cross = weight * now.lazyProduct(later.transpose());
  }
  next.p += noise(motion, x, dt);
  next.p = 0.5 * (next.p + next.p.transpose()).eval();
  return next;
}

template <int D>
MotionFilter<D>::MotionFilter(const MotionModel& model)
    : model_(model), steady_(steady_gains_of(model)) {
  if (D == 1 && needs_plane(model.motion)) {
    const bool turns = std::holds_alternative<CoordinatedTurn>(model.motion);
    throw std::invalid_argument(std::string(turns ? "a coordinated turn" : "a ballistic flight") +
                                " needs two dimensions, and this is a series of single values");
  }
}

template <int D>
std::string_view MotionFilter<D>::name() const {
  return model_.propagation == Propagation::kExtended ? "ekf" : "ukf";
}

template <int D>
std::string MotionFilter<D>::gains_text() const {
  return to_text(steady_);
}

template <int D>
Kinematics<D> MotionFilter<D>::kinematics() const {
  Kinematics<D> k{.position = x_.template head<D>()};
  if (has_velocity()) k.velocity = x_.template segment<D>(D);
  if (has_acceleration()) k.acceleration = x_.template segment<D>(2 * D);
  if constexpr (D == 2) {
    if (const auto* turn = std::get_if<CoordinatedTurn>(&model_.motion); turn != nullptr) {
      k.acceleration = x_[4] * Vector(-x_[3], x_[2]);
    } else if (const auto* flight = std::get_if<Ballistic>(&model_.motion); flight != nullptr) {
      k.acceleration = -x_[4] * k.velocity.norm() * k.velocity - Vector(0.0, flight->gravity);
    }
  }
  return k;
}

template <int D>
bool MotionFilter<D>::start(const Vector& z, const Matrix& covariance) {
  if (!z.allFinite() || !covariance.allFinite() || (covariance.diagonal().array() < 0.0).any()) {
    return refuse_measurement();
  }
  const int n = states_of(model_.motion, D);
  x_.setZero(n);
  p_.setZero(n, n);
  x_.template head<D>() = z;
  p_.template topLeftCorner<D, D>() = covariance;
  if (has_velocity()) {
    p_.diagonal().template segment<D>(D).setConstant(model_.initial_speed * model_.initial_speed);
  }
  for (int i = 2 * D; i < n; ++i) {
    const FirstGuess guess = first_guess_of(model_.motion, i);
    x_[i] = guess.mean;
    p_(i, i) = guess.sigma * guess.sigma;
  }
  // No acceleration is made up at first sight.
  prior_ = estimate_ = Kinematics<D>{.position = z};
  residual_.reset();
  updates_ = 1;
  misses_ = 0;
  started_ = true;
  return true;
}

template <int D>
void MotionFilter<D>::start_from(const Kinematics<D>& guess) {
  if (!start(guess.position)) return;
  MotionState x = x_;
  if (has_velocity()) x.template segment<D>(D) = guess.velocity;
  if (has_acceleration()) x.template segment<D>(2 * D) = guess.acceleration;
  set_state(x, p_);
  updates_ = 0;
}

template <int D>
bool MotionFilter<D>::predict(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    ++refusals_.times;
    return false;
  }
  if (!started_) return true;
  const auto [x, p, cross] = carried(model_.motion, model_.propagation, x_, p_, dt);
  if (!x.allFinite() || !p.allFinite()) {
    ++refusals_.times;
    return false;
  }
  x_ = x;
  p_ = p;
  prior_ = estimate_ = kinematics();
  residual_.reset();
  return true;
}

template <int D>
bool MotionFilter<D>::update(const Vector& z, const Matrix& covariance) {
  if (!started_) return start(z, covariance);
  if (!z.allFinite() || !covariance.allFinite()) return refuse_measurement();
  const Vector r = z - x_.template head<D>();
  const Matrix s = p_.template topLeftCorner<D, D>() + covariance;
  return correct(r, s, p_.template leftCols<D>(), r) || refuse_measurement();
}

template <int D>
bool MotionFilter<D>::update(const Measurement& m) requires(D == 2) {
  if (!started_ || !m.z.allFinite() || !m.r.allFinite()) return refuse_measurement();
  if (std::holds_alternative<PositionModel>(m.model)) return update(Vector(m.z), Matrix(m.r));
  const auto position_of = [](const auto& state) {
    return Eigen::Vector2d(state.template head<2>());
  };
  const auto velocity_of = [](const auto& state) {
    return state.size() >= 4 ? Eigen::Vector2d(state.template segment<2>(2))
                             : Eigen::Vector2d(Eigen::Vector2d::Zero());
  };
  const PredictedMeasurement at_mean = predicted(m.model, position_of(x_), velocity_of(x_));
  if (!at_mean.z.allFinite()) return refuse_measurement();
  if (model_.propagation == Propagation::kExtended) {
    const auto linear = [&]<int N>(std::integral_constant<int, N>) {  // N components are measured
      const auto jacobian = at_mean.jacobian.template leftCols<N>();
      const Cross cross = p_.template leftCols<N>().lazyProduct(jacobian.transpose());
      const MeasuredCovariance s = jacobian.lazyProduct(cross.template topRows<N>()) + m.r;
      const MeasuredVector r = ghtrack::residual(m.model, m.z, at_mean.z);
      return correct(r, s, cross, std::nullopt);
    };
    const bool used = has_velocity() ? linear(std::integral_constant<int, 4>{})
                                     : linear(std::integral_constant<int, 2>{});
    return used || refuse_measurement();
  }
  Points points = points_of(x_, p_);
  const double weight = 1.0 / static_cast<double>(points.cols());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 12> seen(m.z.size(), points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const PredictedMeasurement at_point =
        predicted(m.model, position_of(points.col(i)), velocity_of(points.col(i)));
    seen.col(i) = ghtrack::residual(m.model, at_point.z, at_mean.z);
  }
  const MeasuredVector shift = seen.rowwise().mean();
  seen.colwise() -= shift;
  points.colwise() -= x_;
  const MeasuredCovariance s = weight * seen.lazyProduct(seen.transpose()) + m.r;
  const Cross cross = weight * points.lazyProduct(seen.transpose());
  const MeasuredVector r = ghtrack::residual(m.model, m.z, at_mean.z) - shift;
  return correct(r, s, cross, std::nullopt) || refuse_measurement();
}

template <int D>
bool MotionFilter<D>::refuse_measurement() {
  ++refusals_.measurements;
  return false;
}

/// K = C S⁻¹, x = x' + K r, P = P' − K S Kᵀ for the covariance C of state and measurement.
template <int D>
bool MotionFilter<D>::correct(const MeasuredVector& residual, const MeasuredCovariance& s,
                              const Cross& cross,
                              const std::optional<Vector>& residual_in_position) {
  // With S = L Lᵀ and W = C L⁻ᵀ: x = x' + W L⁻¹ r, P = P' − W Wᵀ.
  const MeasuredCovariance root = lower_root(s);
  if (!(root.diagonal().array() > 0.0).all()) return false;
  Cross w = cross;
  for (Eigen::Index i = 0; i < w.rows(); ++i) {
    w.row(i) = solved(root, MeasuredVector(cross.row(i).transpose())).transpose();
  }
  const MeasuredVector whitened = solved(root, residual);
  const MotionState x = x_ + w.lazyProduct(whitened);
  MotionCovariance p = p_ - w.lazyProduct(w.transpose());
  p = 0.5 * (p + p.transpose()).eval();
  if (!x.allFinite() || !p.allFinite()) return false;

  log_likelihood_ =
      -0.5 * whitened.squaredNorm() - root.diagonal().array().log().sum() -
      0.5 * static_cast<double>(residual.size()) * portable::log(2.0 * std::numbers::pi);
  prior_ = estimate_;
  x_ = x;
  p_ = p;
  estimate_ = kinematics();
  residual_ = residual_in_position.value_or(estimate_.position - prior_.position);
  misses_ = 0;
  ++updates_;
  return true;
}

template <int D>
void MotionFilter<D>::coast() {
  residual_.reset();
  ++misses_;
}

template <int D>
void MotionFilter<D>::set_state(const MotionState& state, const MotionCovariance& covariance) {
  x_ = state;
  p_ = covariance;
  prior_ = estimate_ = kinematics();
}

template <int D>
void MotionFilter<D>::adopt(const Knowledge<D>& known) {
  const bool knows_velocity = has_velocity() && known.order >= 1;
  const bool knows_acceleration = has_acceleration() && known.order >= 2;
  const int shared = knows_acceleration ? 3 * D : knows_velocity ? 2 * D : D;
  MotionState x = x_;
  x.template head<D>() = known.state.position;
  if (knows_velocity) x.template segment<D>(D) = known.state.velocity;
  if (knows_acceleration) x.template segment<D>(2 * D) = known.state.acceleration;
  MotionCovariance p = p_;
  p.topRows(shared).setZero();
  p.leftCols(shared).setZero();
  const AxisCovariance<Eigen::Array<double, D, 1>>& c = known.covariance;
  const auto set = [&](int i, int j, const Eigen::Array<double, D, 1>& value) {
    for (int axis = 0; axis < D; ++axis) {
      p(D * i + axis, D * j + axis) = p(D * j + axis, D * i + axis) = value[axis];
    }
  };
  set(0, 0, c.xx);
  if (knows_velocity) {
    set(0, 1, c.xv);
    set(1, 1, c.vv);
  }
  if (knows_acceleration) {
    set(0, 2, c.xa);
    set(1, 2, c.va);
    set(2, 2, c.aa);
  }
  set_state(x, p);
}

template <int D>
Knowledge<D> MotionFilter<D>::knowledge() const {
  const auto get = [&](int i, int j) {
    Eigen::Array<double, D, 1> values;
    for (int axis = 0; axis < D; ++axis) values[axis] = p_(D * i + axis, D * j + axis);
    return values;
  };
  Knowledge<D> known{0, kinematics(), {get(0, 0), {}, {}, {}, {}, {}}};
  if (!has_velocity()) return known;
  known.order = 1;
  known.covariance.xv = get(0, 1);
  known.covariance.vv = get(1, 1);
  if (!has_acceleration()) return known;
  known.order = 2;
  known.covariance.xa = get(0, 2);
  known.covariance.va = get(1, 2);
  known.covariance.aa = get(2, 2);
  return known;
}

template class MotionFilter<1>;
template class MotionFilter<2>;

}  // namespace ghtrack

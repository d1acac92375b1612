#include "tracker/filters/motion_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

bool is_linear(const TargetMotion& motion) {
  return std::holds_alternative<PolynomialMotion>(motion);
}

/// ∂ moved / ∂ state by central differences, in steps that are small against the errors.
MotionCovariance derivative(const TargetMotion& motion, const MotionState& x,
                            const MotionCovariance& p, double dt) {
  const Eigen::Index n = x.size();
  MotionCovariance f(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (is_linear(motion)) {
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
  if (is_linear(motion) || propagation == Propagation::kExtended) {
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

MotionFilter::MotionFilter(const MotionModel& model)
    : model_(model), steady_(steady_gains_of(model)) {}

std::string_view MotionFilter::name() const {
  return model_.propagation == Propagation::kExtended ? "ekf" : "ukf";
}

std::string MotionFilter::gains_text() const { return to_text(steady_); }

Kinematics<2> MotionFilter::kinematics() const {
  Kinematics<2> k{x_.head<2>(), x_.segment<2>(2), Vector::Zero()};
  if (x_.size() == 6) k.acceleration = x_.segment<2>(4);
  if (const auto* turn = std::get_if<CoordinatedTurn>(&model_.motion); turn != nullptr) {
    k.acceleration = x_[4] * Vector(-x_[3], x_[2]);
  } else if (const auto* flight = std::get_if<Ballistic>(&model_.motion); flight != nullptr) {
    k.acceleration = -x_[4] * k.velocity.norm() * k.velocity - Vector(0.0, flight->gravity);
  }
  return k;
}

bool MotionFilter::start(const Vector& z, const Matrix& covariance) {
  if (!z.allFinite() || !covariance.allFinite() || (covariance.diagonal().array() < 0.0).any()) {
    ++refusals_.measurements;
    return false;
  }
  const int n = states_of(model_.motion);
  x_.setZero(n);
  p_.setZero(n, n);
  x_.head<2>() = z;
  p_.topLeftCorner<2, 2>() = covariance;
  p_.diagonal().segment<2>(2).setConstant(model_.initial_speed * model_.initial_speed);
  for (int i = 4; i < n; ++i) {
    const FirstGuess guess = first_guess_of(model_.motion, i);
    x_[i] = guess.mean;
    p_(i, i) = guess.sigma * guess.sigma;
  }
  // No acceleration is made up at first sight.
  prior_ = estimate_ = Kinematics<2>{.position = z};
  residual_.reset();
  updates_ = 1;
  misses_ = 0;
  started_ = true;
  return true;
}

bool MotionFilter::predict(double dt) {
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

bool MotionFilter::update(const Vector& z, const Matrix& covariance) {
  if (!started_) return start(z, covariance);
  return update(Measurement{z, covariance, PositionModel{}});
}

bool MotionFilter::update(const Measurement& m) {
  const auto refuse = [this] {
    ++refusals_.measurements;
    return false;
  };
  if (!started_ || !m.z.allFinite() || !m.r.allFinite()) return refuse();
  const PredictedMeasurement at_mean = predicted(m.model, x_.head<2>(), x_.segment<2>(2));
  if (!at_mean.z.allFinite()) return refuse();
  const bool is_position = std::holds_alternative<PositionModel>(m.model);
  if (model_.propagation == Propagation::kExtended || is_position) {
    const Cross cross = p_.leftCols<4>().lazyProduct(at_mean.jacobian.transpose());
    const MeasuredCovariance s = at_mean.jacobian.lazyProduct(cross.topRows<4>()) + m.r;
    const MeasuredVector r = ghtrack::residual(m.model, m.z, at_mean.z);
    const auto in_position = is_position ? std::optional<Vector>(r.head<2>()) : std::nullopt;
    return correct(r, s, cross, in_position) || refuse();
  }
  Points points = points_of(x_, p_);
  const double weight = 1.0 / static_cast<double>(points.cols());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 12> seen(m.z.size(), points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const PredictedMeasurement at_point =
        predicted(m.model, points.col(i).head<2>(), points.col(i).segment<2>(2));
    seen.col(i) = ghtrack::residual(m.model, at_point.z, at_mean.z);
  }
  const MeasuredVector shift = seen.rowwise().mean();
  seen.colwise() -= shift;
  points.colwise() -= x_;
  const MeasuredCovariance s = weight * seen.lazyProduct(seen.transpose()) + m.r;
  const Cross cross = weight * points.lazyProduct(seen.transpose());
  const MeasuredVector r = ghtrack::residual(m.model, m.z, at_mean.z) - shift;
  return correct(r, s, cross, std::nullopt) || refuse();
}

/// K = C S⁻¹, x = x' + K r, P = P' − K S Kᵀ for the covariance C of state and measurement.
bool MotionFilter::correct(const MeasuredVector& residual, const MeasuredCovariance& s,
                           const Cross& cross, const std::optional<Vector>& residual_in_position) {
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

void MotionFilter::coast() {
  residual_.reset();
  ++misses_;
}

void MotionFilter::set_state(const MotionState& state, const MotionCovariance& covariance) {
  x_ = state;
  p_ = covariance;
  prior_ = estimate_ = kinematics();
}

void MotionFilter::adopt(const Knowledge<2>& known) {
  const bool has_acceleration = x_.size() == 6 && known.order >= 2;
  const int shared = has_acceleration ? 6 : known.order >= 1 ? 4 : 2;
  MotionState x = x_;
  x.head<2>() = known.state.position;
  if (known.order >= 1) x.segment<2>(2) = known.state.velocity;
  if (has_acceleration) x.segment<2>(4) = known.state.acceleration;
  MotionCovariance p = p_;
  p.topRows(shared).setZero();
  p.leftCols(shared).setZero();
  const AxisCovariance<Eigen::Array2d>& c = known.covariance;
  const auto set = [&](int i, int j, const Eigen::Array2d& value) {
    for (int axis = 0; axis < 2; ++axis) {
      p(2 * i + axis, 2 * j + axis) = p(2 * j + axis, 2 * i + axis) = value[axis];
    }
  };
  set(0, 0, c.xx);
  if (known.order >= 1) {
    set(0, 1, c.xv);
    set(1, 1, c.vv);
  }
  if (has_acceleration) {
    set(0, 2, c.xa);
    set(1, 2, c.va);
    set(2, 2, c.aa);
  }
  set_state(x, p);
}

Knowledge<2> MotionFilter::knowledge() const {
  const auto get = [&](int i, int j) {
    return Eigen::Array2d(p_(2 * i, 2 * j), p_(2 * i + 1, 2 * j + 1));
  };
  Knowledge<2> known{1, kinematics(), {get(0, 0), get(0, 1), {}, get(1, 1), {}, {}}};
  if (x_.size() != 6) return known;
  known.order = 2;
  known.covariance.xa = get(0, 2);
  known.covariance.va = get(1, 2);
  known.covariance.aa = get(2, 2);
  return known;
}

}  // namespace ghtrack

#include "tracker/filters/gain_filter.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

template <class Axes>
bool is_finite(const AxisCovariance<Axes>& p) {
  return (p.xx + p.xv + p.xa + p.vv + p.va + p.aa).allFinite();  // so is every part
}

template <class Axes>
bool is_variance(const Axes& variance) {
  return variance.allFinite() && (variance >= 0.0).all();
}

template <class Axes>
AxisCovariance<Axes> on_all_axes(const AxisCovariance<double>& p) {
  return {Axes::Constant(p.xx), Axes::Constant(p.xv), Axes::Constant(p.xa),
          Axes::Constant(p.vv), Axes::Constant(p.va), Axes::Constant(p.aa)};
}

bool reaches(const Gains& large, const Gains& small) {
  return large.g >= small.g && large.h >= small.h && large.k >= small.k;
}

bool is_near(double value, double goal) {
  constexpr double kSettled = 0.01;
  return std::abs(value - goal) <= kSettled * goal;
}

/// The best gain for an error known: Kalman's, on each axis.
/// @param p  covariance of the position's error with those of position, velocity and acceleration
template <class Axes>
AxisGain<Axes> optimal_gain(const AxisGain<Axes>& p, const Axes& variance) {
  const Axes total = (p.x + variance).max(std::numeric_limits<double>::min());
  return {p.x / total, p.v / total, p.a / total};
}
template <class Axes>
AxisGain<Axes> optimal_gain(const AxisCovariance<Axes>& p, const Axes& variance) {
  return optimal_gain(AxisGain<Axes>{p.xx, p.xv, p.xa}, variance);
}

/// The error of a doubtful residual is taken to be as much larger as it takes for the pull of the
/// limit itself (Huber 1964).
/// @param error  variance of the position before the correction
template <class Axes>
Axes doubted(const Axes& residual, const Axes& error, const Axes& variance, double huber) {
  const Axes s = error + variance;
  return (std::sqrt((residual.square() / s).sum()) / huber) * s - error;
}

Gains larger(const Gains& a, const Gains& b) {
  return {a.order, std::max(a.g, b.g), std::max(a.h, b.h), std::max(a.k, b.k)};
}

}  // namespace

template <int D>
GainFilter<D>::Design::Design(const GainSchedule& gains, const ErrorModel& model)
    : schedule(gains), errors(model) {
  has_belief =
      gains.source == GainSource::kTable && is_stable(gains.steady) &&
      (gains.irregular_time == IrregularTime::kGainsFromCovariance || std::isfinite(model.huber));
  if (!has_belief) return;
  implied = implied_noise(gains.steady, model.sigma, gains.interval);
  settled = steady_covariance(implied, gains.steady.order, model.sigma, gains.interval);
}

template <int D>
GainFilter<D>::GainFilter(const GainSchedule& schedule, const ErrorModel& errors)
    : design_(std::make_shared<const Design>(schedule, errors)),
      belief_(on_all_axes<Axes>({})),
      covariance_(belief_),
      noise_(belief_),
      used_{schedule.steady, schedule.interval},
      interval_(schedule.interval) {}

template <int D>
GainFilter<D>::GainFilter(const Gains& gains, double dt, const Kinematics<D>& guess, double sigma,
                          IrregularTime irregular_time)
    : GainFilter(GainSchedule{.steady = gains,
                              .interval = dt,
                              .start_up = StartUp::kNone,
                              .irregular_time = irregular_time},
                 ErrorModel{.sigma = sigma}) {
  start_from(guess);
}

template <int D>
void GainFilter<D>::start_from(const Kinematics<D>& guess) {
  prior_ = guess;
  estimate_ = guess;
  started_ = true;
  starting_up_ = false;
}

template <int D>
std::string_view GainFilter<D>::name() const {
  constexpr std::array<std::string_view, 3> kNames = {"order0", "gh", "ghk"};
  return kNames[static_cast<std::size_t>(design_->schedule.steady.order)];
}

template <int D>
std::string GainFilter<D>::gains_text() const {
  return to_text(design_->schedule.steady);
}

template <int D>
bool GainFilter<D>::start(const Vector& z, const Matrix& covariance) {
  const Axes variance = covariance.diagonal().array();
  if (!z.allFinite() || !is_variance(variance)) return refuse_measurement();
  const int order = design_->schedule.steady.order;
  prior_ = estimate_ = Kinematics<D>{.position = z};
  residual_.reset();
  covariance_ = on_all_axes<Axes>({});
  covariance_.xx = variance;
  if (order >= 1)
    covariance_.vv.setConstant(design_->errors.initial_speed * design_->errors.initial_speed);
  if (order >= 2) {
    covariance_.aa.setConstant(design_->errors.initial_acceleration *
                               design_->errors.initial_acceleration);
  }
  belief_ = noise_ = covariance_;
  left_ = {variance, Axes::Zero(), Axes::Zero()};
  elapsed_ = 0.0;
  updates_ = instants_ = 1;
  misses_ = 0;
  started_ = true;
  starting_up_ = design_->schedule.start_up != StartUp::kNone;
  on_schedule_ = true;
  return true;
}

template <int D>
bool GainFilter<D>::start_at(const Kinematics<D>& first) {
  if (!first.is_finite() || !start(first.position)) return refuse_measurement();
  if (design_->schedule.start_up == StartUp::kNone) prior_ = estimate_ = first;
  return true;
}

template <int D>
bool GainFilter<D>::predict(double dt) {
  const Kinematics<D> next = extrapolated(estimate_, dt);
  AxisCovariance<Axes> covariance = extrapolated(covariance_, dt);
  if (has_process_noise()) {
    covariance += on_all_axes<Axes>(
        process_noise(design_->errors.process_model, design_->schedule.steady.order,
                      design_->errors.process_intensity, dt, design_->errors.renewal));
  }
  if (!(dt > 0.0) || !std::isfinite(dt) || !next.is_finite() || !is_finite(covariance)) {
    ++refusals_.times;
    return false;
  }
  if (!started_) return true;
  if (design_->has_belief) carry_belief(dt);
  prior_ = estimate_ = next;
  covariance_ = covariance;
  if (has_process_noise()) noise_ = extrapolated(noise_, dt);
  residual_.reset();
  interval_ = dt;
  elapsed_ += dt;
  return true;
}

/// While the steady gains of the table are due, the belief is known beforehand.
template <int D>
void GainFilter<D>::carry_belief(double dt) {
  const bool on_time = design_->schedule.irregular_time != IrregularTime::kGainsFromCovariance ||
                       design_->schedule.is_nominal(dt);
  if (is_steady() && on_time) return;
  if (!on_time) leave_schedule();
  belief_ = extrapolated(belief_, dt);
  belief_ += on_all_axes<Axes>(design_->implied.over(dt));
}

/// What the steady gains take the error to be now.
template <int D>
auto GainFilter<D>::settled_belief() const -> AxisCovariance<Axes> {
  AxisCovariance<double> p = design_->settled;
  if (elapsed_ > 0.0) {
    p = extrapolated(p, elapsed_);
    p += design_->implied.over(elapsed_);
  }
  return on_all_axes<Axes>(p);
}

/// From here on the gains follow belief_.
template <int D>
void GainFilter<D>::leave_schedule() {
  if (is_steady()) belief_ = settled_belief();
  on_schedule_ = false;
}

/// The table's steady gains are due again when they are as good as those of belief_.
template <int D>
void GainFilter<D>::return_to_schedule() {
  for (int axis = 0; axis < D; ++axis) {
    if (!is_near(belief_.xx[axis], design_->settled.xx) ||
        !is_near(belief_.vv[axis], design_->settled.vv) ||
        !is_near(belief_.aa[axis], design_->settled.aa)) {
      return;
    }
  }
  on_schedule_ = true;
  starting_up_ = false;
}

/// The gains that are due, and the time that they count from.
template <int D>
auto GainFilter<D>::scheduled() const -> Scheduled {
  const bool has_law = !std::holds_alternative<ConstantLaw>(design_->schedule.law);
  const bool from_elapsed =
      design_->schedule.irregular_time == IrregularTime::kGainsFromElapsed ||
      (design_->schedule.irregular_time == IrregularTime::kGainsFromCovariance && has_law);
  const double interval = from_elapsed ? elapsed_ : interval_;
  const Gains steady = design_->schedule.irregular_time == IrregularTime::kFixedGains
                           ? design_->schedule.steady
                           : design_->schedule.at(interval);
  const int order = design_->schedule.steady.order;
  const int n = instants_ + 1;
  if (!starting_up_) return {steady, interval};
  // A polynomial through the first points is the only unbiased choice, whatever the steady gains.
  if (n <= order + 1) return {start_up_gains(order, n), elapsed_};
  return {larger(start_up_gains(order, n), steady), elapsed_};
}

template <int D>
auto GainFilter<D>::as_scheduled(const AxisGain<Axes>& gain) const -> Scheduled {
  const double t = interval_;
  return {{design_->schedule.steady.order, gain.x[0], gain.v[0] * t, 0.5 * gain.a[0] * t * t}, t};
}

/// Is the residual beyond the Huber limit, and to be shortened? It says nothing of outliers before
/// all derivatives are known, and one that repeats itself on the same side is no outlier: the
/// target has moved otherwise than believed. A measurement too rough to see it does not speak
/// against it.
template <int D>
bool GainFilter<D>::doubts(const Vector& residual, const Axes& error, const Axes& variance) {
  constexpr int kMostInARow = 2;
  if (instants_ <= design_->schedule.steady.order) return false;
  const auto would_be_far = [&](const Vector& distance) {
    return (distance.array().square() / (error + variance)).sum() >
           design_->errors.huber * design_->errors.huber;
  };
  if (!would_be_far(residual)) {
    if (would_be_far(last_far_)) far_in_a_row_ = 0;
    return false;
  }
  const bool repeats = far_in_a_row_ > 0 && residual.dot(last_far_) > 0.0;
  far_in_a_row_ = repeats ? far_in_a_row_ + 1 : 1;
  last_far_ = residual;
  return far_in_a_row_ <= kMostInARow;
}

template <int D>
bool GainFilter<D>::update(const Vector& z, const Matrix& covariance) {
  if (!started_) return start(z, covariance);
  const Axes variance = covariance.diagonal().array();
  if (!z.allFinite() || !is_variance(variance)) return refuse_measurement();
  const Vector residual = z - estimate_.position;
  if (design_->schedule.source == GainSource::kCovariance) {
    const bool doubtful = limits_residuals() && doubts(residual, covariance_.xx, variance);
    return update_by(covariance_, z, variance, doubtful);
  }
  // A second sensor at the same instant has no place in a table.
  if (elapsed_ == 0.0 && on_schedule_) {
    const bool doubtful = limits_residuals() && doubts(residual, left_.x, variance);
    return update_at_same_instant(z, variance, doubtful);
  }
  if (!design_->has_belief) return update_by_table(z, variance);
  const bool doubtful = limits_residuals() &&
                        doubts(residual, (is_steady() ? settled_belief() : belief_).xx, variance);
  if (doubtful) leave_schedule();
  if (on_schedule_) return update_by_table(z, variance);
  if (!update_by(belief_, z, variance, doubtful)) return false;
  return_to_schedule();
  return true;
}

template <int D>
bool GainFilter<D>::update_by_table(const Vector& z, const Axes& variance) {
  const Scheduled due = scheduled();
  const auto& [gains, dt] = due;
  if (!correct(z, variance,
               {Axes::Constant(gains.g), Axes::Constant(gains.h / dt),
                Axes::Constant(2.0 * gains.k / (dt * dt))})) {
    return false;
  }
  used_ = due;
  if (starting_up_ && design_->has_belief) {
    belief_ = corrected(belief_, optimal_gain(belief_, variance), variance);
  }
  const int steady_from = design_->schedule.start_up == StartUp::kTwoPoint ? 2 : gains.order + 1;
  if (starting_up_ && instants_ >= steady_from) {
    starting_up_ = design_->schedule.start_up == StartUp::kGrowingMemory &&
                   !reaches(design_->schedule.steady, start_up_gains(gains.order, instants_));
  }
  return true;
}

/// Goes on from the gains of the last update as if they had been the best ones: then the two
/// measurements make the same of the prediction as their mean. From the first instant the table
/// goes on, later the gains follow the belief.
template <int D>
bool GainFilter<D>::update_at_same_instant(const Vector& z, const Axes& variance,
                                           bool is_doubtful) {
  const Axes residual = (z - estimate_.position).array();
  const Axes trusted =
      is_doubtful ? doubted(residual, left_.x, variance, design_->errors.huber) : variance;
  const AxisGain<Axes> gain = optimal_gain(left_, trusted);
  if (!correct(z, trusted, gain)) return false;
  used_ = as_scheduled(gain);
  if (instants_ <= 1) {
    belief_ = covariance_;
  } else if (design_->has_belief) {
    leave_schedule();
    belief_ = corrected(belief_, optimal_gain(belief_, trusted), trusted);
    return_to_schedule();
  }
  return true;
}

/// Corrects with the best gain for an error known.
/// @param belief  the error, which is corrected, too; may be covariance_ itself
template <int D>
bool GainFilter<D>::update_by(AxisCovariance<Axes>& belief, const Vector& z, const Axes& variance,
                              bool is_doubtful) {
  const Axes residual = (z - estimate_.position).array();
  const Axes trusted =
      is_doubtful ? doubted(residual, belief.xx, variance, design_->errors.huber) : variance;
  const AxisGain<Axes> gain = optimal_gain(belief, trusted);
  const bool is_own = &belief == &covariance_;
  const AxisCovariance<Axes> next = is_own ? belief : corrected(belief, gain, trusted);
  if (!is_finite(next) || !correct(z, trusted, gain)) return false;
  if (!is_own) belief = next;
  used_ = as_scheduled(gain);
  return true;
}

template <int D>
bool GainFilter<D>::update(const Vector& z, const Gains& gains) {
  if (!started_) return start(z);
  const Axes variance = Axes::Constant(design_->errors.sigma * design_->errors.sigma);
  const bool used = correct(z, variance,
                            {Axes::Constant(gains.g), Axes::Constant(gains.h / interval_),
                             Axes::Constant(2.0 * gains.k / (interval_ * interval_))});
  if (used) used_ = {gains, interval_};
  return used;
}

template <int D>
bool GainFilter<D>::correct(const Vector& z, const Axes& variance, const AxisGain<Axes>& gain) {
  const Vector residual = z - estimate_.position;
  Kinematics<D> next = estimate_;
  next.position.array() += gain.x * residual.array();
  next.velocity.array() += gain.v * residual.array();
  next.acceleration.array() += gain.a * residual.array();
  const AxisCovariance<Axes> covariance = corrected(covariance_, gain, variance);
  if (!residual.allFinite() || !is_variance(variance) || !next.is_finite() ||
      !is_finite(covariance)) {
    return refuse_measurement();
  }
  prior_ = estimate_;
  estimate_ = next;
  covariance_ = covariance;
  if (has_process_noise()) noise_ = corrected(noise_, gain, variance);
  left_ = {gain.x * variance, gain.v * variance, gain.a * variance};
  residual_ = residual;
  if (elapsed_ > 0.0) ++instants_;
  elapsed_ = 0.0;
  misses_ = 0;
  ++updates_;
  return true;
}

template <int D>
void GainFilter<D>::coast() {
  residual_.reset();
  ++misses_;
}

template <int D>
void GainFilter<D>::adopt(const Knowledge<D>& known) {
  const int order = design_->schedule.steady.order;
  estimate_ = {.position = known.state.position};
  covariance_ = on_all_axes<Axes>({});
  covariance_.xx = known.covariance.xx;
  if (order >= 1) {
    covariance_.vv.setConstant(design_->errors.initial_speed * design_->errors.initial_speed);
  }
  if (order >= 2) {
    covariance_.aa.setConstant(design_->errors.initial_acceleration *
                               design_->errors.initial_acceleration);
  }
  if (order >= 1 && known.order >= 1) {
    estimate_.velocity = known.state.velocity;
    covariance_.xv = known.covariance.xv;
    covariance_.vv = known.covariance.vv;
  }
  if (order >= 2 && known.order >= 2) {
    estimate_.acceleration = known.state.acceleration;
    covariance_.xa = known.covariance.xa;
    covariance_.va = known.covariance.va;
    covariance_.aa = known.covariance.aa;
  }
  prior_ = estimate_;
  noise_ = covariance_;
  starting_up_ = false;
  on_schedule_ = true;
}

template <int D>
bool GainFilter<D>::refuse_measurement() {
  ++refusals_.measurements;
  return false;
}

template class GainFilter<1>;
template class GainFilter<2>;
template class GainFilter<3>;

std::string to_text(const Gains& gains) {
  const std::array<std::pair<const char*, double>, 3> parts = {
      {{"g=", gains.g}, {" h=", gains.h}, {" k=", gains.k}}};
  std::string text;
  for (int i = 0; i <= gains.order; ++i) {
    const auto& [label, value] = parts[static_cast<std::size_t>(i)];
    std::array<char, 32> digits{};
    auto* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                    std::chars_format::general, 4)
                          .ptr;
    text.append(label).append(digits.data(), end);
  }
  return text;
}

}  // namespace ghtrack

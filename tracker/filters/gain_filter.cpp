#include "tracker/filters/gain_filter.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace ghtrack {
namespace {

template <class Axes>
bool is_finite(const AxisCovariance<Axes>& p) {
  return p.xx.allFinite() && p.xv.allFinite() && p.xa.allFinite() && p.vv.allFinite() &&
         p.va.allFinite() && p.aa.allFinite();
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

Gains larger(const Gains& a, const Gains& b) {
  return {a.order, std::max(a.g, b.g), std::max(a.h, b.h), std::max(a.k, b.k)};
}

}  // namespace

template <int D>
GainFilter<D>::GainFilter(const GainSchedule& schedule, const ErrorModel& errors)
    : schedule_(schedule),
      errors_(errors),
      covariance_(on_all_axes<Axes>({})),
      noise_(covariance_),
      used_{schedule.steady, schedule.interval},
      interval_(schedule.interval) {}

template <int D>
GainFilter<D>::GainFilter(const Gains& gains, double dt, const Kinematics<D>& guess, double sigma)
    : GainFilter(GainSchedule{.steady = gains, .interval = dt, .start_up = StartUp::kNone},
                 ErrorModel{.sigma = sigma}) {
  prior_ = guess;
  estimate_ = guess;
  started_ = true;
  starting_up_ = false;
}

template <int D>
std::string_view GainFilter<D>::name() const {
  constexpr std::array<std::string_view, 3> kNames = {"order0", "gh", "ghk"};
  return kNames[static_cast<std::size_t>(schedule_.steady.order)];
}

template <int D>
std::string GainFilter<D>::gains_text() const {
  return to_text(schedule_.steady);
}

template <int D>
bool GainFilter<D>::start(const Vector& z, const Matrix& covariance) {
  const Axes variance = covariance.diagonal().array();
  if (!z.allFinite() || !is_variance(variance)) return refuse_measurement();
  const int order = schedule_.steady.order;
  prior_ = estimate_ = Kinematics<D>{.position = z};
  residual_.reset();
  covariance_ = on_all_axes<Axes>({});
  covariance_.xx = variance;
  if (order >= 1) covariance_.vv.setConstant(errors_.initial_speed * errors_.initial_speed);
  if (order >= 2) {
    covariance_.aa.setConstant(errors_.initial_acceleration * errors_.initial_acceleration);
  }
  noise_ = covariance_;
  elapsed_ = 0.0;
  updates_ = 1;
  misses_ = 0;
  started_ = true;
  starting_up_ = schedule_.start_up != StartUp::kNone;
  return true;
}

template <int D>
bool GainFilter<D>::predict(double dt) {
  const Kinematics<D> next = extrapolated(estimate_, dt);
  AxisCovariance<Axes> covariance = extrapolated(covariance_, dt);
  if (errors_.process_intensity > 0.0) {
    covariance += on_all_axes<Axes>(process_noise(errors_.process_model, schedule_.steady.order,
                                                  errors_.process_intensity, dt));
  }
  if (!(dt > 0.0) || !std::isfinite(dt) || !next.is_finite() || !is_finite(covariance)) {
    ++refusals_.times;
    return false;
  }
  if (!started_) return true;
  prior_ = estimate_ = next;
  covariance_ = covariance;
  noise_ = extrapolated(noise_, dt);
  residual_.reset();
  interval_ = dt;
  elapsed_ += dt;
  return true;
}

/// The gains that are due, and the time that they count from.
template <int D>
auto GainFilter<D>::scheduled() const -> Scheduled {
  const bool from_elapsed = schedule_.irregular_time == IrregularTime::kGainsFromElapsed;
  const double interval = from_elapsed ? elapsed_ : interval_;
  const Gains steady = schedule_.irregular_time == IrregularTime::kFixedGains
                           ? schedule_.steady
                           : schedule_.at(interval);
  const int order = schedule_.steady.order;
  const int n = updates_ + 1;
  if (!starting_up_) return {steady, interval};
  // A polynomial through the first points is the only unbiased choice, whatever the steady gains.
  if (n <= order + 1) return {start_up_gains(order, n), elapsed_};
  return {larger(start_up_gains(order, n), steady), elapsed_};
}

/// The best gain for the error known so far: Kalman's, on each axis.
template <int D>
auto GainFilter<D>::optimal_gain(const Axes& variance) const -> AxisGain<Axes> {
  const Axes total = (covariance_.xx + variance).max(std::numeric_limits<double>::min());
  return {covariance_.xx / total, covariance_.xv / total, covariance_.xa / total};
}

template <int D>
auto GainFilter<D>::as_scheduled(const AxisGain<Axes>& gain) const -> Scheduled {
  const double t = interval_;
  return {{schedule_.steady.order, gain.x[0], gain.v[0] * t, 0.5 * gain.a[0] * t * t}, t};
}

template <int D>
bool GainFilter<D>::update(const Vector& z, const Matrix& covariance) {
  if (!started_) return start(z, covariance);
  const Axes variance = covariance.diagonal().array();
  // A second sensor at the same instant has no place in a table.
  const bool same_instant = updates_ > 0 && elapsed_ == 0.0;
  if (same_instant || schedule_.source == GainSource::kCovariance) {
    const AxisGain<Axes> gain = optimal_gain(variance);
    if (!correct(z, variance, gain)) return false;
    used_ = as_scheduled(gain);
    return true;
  }

  const Scheduled due = scheduled();
  const auto& [gains, dt] = due;
  if (!correct(z, variance,
               {Axes::Constant(gains.g), Axes::Constant(gains.h / dt),
                Axes::Constant(2.0 * gains.k / (dt * dt))})) {
    return false;
  }
  used_ = due;
  const int steady_from = schedule_.start_up == StartUp::kTwoPoint ? 2 : gains.order + 1;
  if (starting_up_ && updates_ >= steady_from) {
    starting_up_ = schedule_.start_up == StartUp::kGrowingMemory &&
                   !reaches(schedule_.steady, start_up_gains(gains.order, updates_));
  }
  return true;
}

template <int D>
bool GainFilter<D>::update(const Vector& z, const Gains& gains) {
  if (!started_) return start(z);
  const Axes variance = Axes::Constant(errors_.sigma * errors_.sigma);
  const bool used = correct(z, variance,
                            {Axes::Constant(gains.g), Axes::Constant(gains.h / interval_),
                             Axes::Constant(2.0 * gains.k / (interval_ * interval_))});
  if (used) used_ = {gains, interval_};
  return used;
}

template <int D>
bool GainFilter<D>::correct(const Vector& z, const Axes& variance, const AxisGain<Axes>& gain) {
  const Vector residual = z - estimate_.position;
  Axes used = residual.array();
  if (std::isfinite(errors_.huber)) {
    const double distance = std::sqrt((used.square() / (covariance_.xx + variance)).sum());
    if (distance > errors_.huber) used *= errors_.huber / distance;
  }
  Kinematics<D> next = estimate_;
  next.position.array() += gain.x * used;
  next.velocity.array() += gain.v * used;
  next.acceleration.array() += gain.a * used;
  const AxisCovariance<Axes> covariance = corrected(covariance_, gain, variance);
  if (!residual.allFinite() || !is_variance(variance) || !next.is_finite() ||
      !is_finite(covariance)) {
    return refuse_measurement();
  }
  prior_ = estimate_;
  estimate_ = next;
  covariance_ = covariance;
  noise_ = corrected(noise_, gain, variance);
  residual_ = residual;
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
  const int order = schedule_.steady.order;
  estimate_ = {.position = known.state.position};
  covariance_ = on_all_axes<Axes>({});
  covariance_.xx = known.covariance.xx;
  if (order >= 1) {
    covariance_.vv.setConstant(errors_.initial_speed * errors_.initial_speed);
  }
  if (order >= 2) {
    covariance_.aa.setConstant(errors_.initial_acceleration * errors_.initial_acceleration);
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

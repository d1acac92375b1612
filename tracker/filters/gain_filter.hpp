#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gain_schedule.hpp"
#include "tracker/filters/gains/gains.hpp"
#include "tracker/filters/kinematics.hpp"

namespace ghtrack {

/// What a filter with designed gains assumes about errors. It shapes the predicted error and the
/// Huber limit, and gains that follow the predicted error.
struct ErrorModel {
  double sigma = 1.0;  // of a measurement, per axis [m]
  ProcessModel process_model = ProcessModel::kPiecewiseConstant;
  double process_intensity = 0.0;     // see process_noise(); 0: the target moves as the filter says
  double initial_speed = 0.0;         // 1-sigma velocity per axis at first sight [m/s]
  double initial_acceleration = 0.0;  // the same for the acceleration [m/s²]
  double huber = std::numeric_limits<double>::infinity();  // longest residual used, in sigmas
};

/// The g, g-h or g-h-k filter on D axes that share their gains. With T the time between updates:
///   x' = x + v T + a T²/2,  v' = v + a T         predict
///   r = z − x'                                   residual [m]
///   x = x' + g r,  v = v' + (h/T) r,  a = a' + (2k/T²) r    update
/// Beside the state it carries the covariance that these gains give to its error, exactly: at
/// start-up that of growing memory, later the variance reduction factors, more after each miss.
/// Lag is not in it: see steady_lag(). With GainSource::kCovariance the gains in turn are the best
/// ones for that covariance: the filter is the Kalman filter of the same process noise.
///
/// A value: copies are independent filters. Steps that cannot be used are refused, counted, and
/// leave the filter as it was. @ingroup gh_family
template <int D>
class GainFilter {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;
  using Axes = Eigen::Array<double, D, 1>;

  /// A filter that starts at its first measurement.
  GainFilter(const GainSchedule& schedule, const ErrorModel& errors);

  /// The textbook's filter: constant gains, and an initial guess that is taken as certain.
  /// The guess holds at the time from which the first predict() counts.
  /// @param dt  nominal step [s]
  GainFilter(const Gains& gains, double dt, const Kinematics<D>& guess, double sigma = 1.0);

  /// "order0", "gh" or "ghk".
  std::string_view name() const;
  /// "g=0.1 h=0.005".
  std::string gains_text() const;
  const Gains& steady_gains() const { return schedule_.steady; }
  double nominal_interval() const { return schedule_.interval; }
  double sigma() const { return errors_.sigma; }

  /// Takes the first measurement as the position; velocity and acceleration are unknown.
  bool start(const Vector& z, const Matrix& covariance);
  bool start(const Vector& z) { return start(z, nominal_covariance()); }

  /// Carries the state dt seconds on. @returns false if refused
  bool predict(double dt);

  /// Corrects the prediction with a measured position [m]; the first one starts the filter.
  /// @param covariance  of the measurement's error [m²]; its diagonal enters the predicted error
  /// @returns false if refused
  bool update(const Vector& z, const Matrix& covariance);
  bool update(const Vector& z) { return update(z, nominal_covariance()); }
  /// The same with these gains for once, per time since the last prediction.
  bool update(const Vector& z, const Gains& gains);

  /// Says that there is no measurement for this prediction, although there should be.
  void coast();

  /// Goes on from what another filter knows at this instant; derivatives that it does not know are
  /// as uncertain as at first sight. The start-up is over.
  void adopt(const Knowledge<D>& known);
  Knowledge<D> knowledge() const { return {schedule_.steady.order, estimate_, covariance_}; }

  bool is_started() const { return started_; }
  int updates() const { return updates_; }
  int consecutive_misses() const { return misses_; }
  const Refusals& refusals() const { return refusals_; }

  /// The state before the last update; equal to estimate() between predict() and update().
  const Kinematics<D>& prior() const { return prior_; }
  const Kinematics<D>& estimate() const { return estimate_; }
  /// z − predicted position of the last update; nothing after a prediction.
  const std::optional<Vector>& residual() const { return residual_; }

  /// Gains of the last update, and the time T that they were divided by [s].
  const Gains& used_gains() const { return used_.gains; }
  double used_interval() const { return used_.interval; }

  /// Predicted 1-sigma errors of estimate(), per axis.
  Vector position_sigma() const { return covariance_.xx.max(0.0).sqrt().matrix(); }
  Vector velocity_sigma() const { return covariance_.vv.max(0.0).sqrt().matrix(); }
  /// The part of position_sigma() that measurement errors cause: what is left when the target moves
  /// exactly as the filter assumes.
  Vector noise_sigma() const { return noise_.xx.max(0.0).sqrt().matrix(); }
  /// The same of velocity_sigma().
  Vector noise_velocity_sigma() const { return noise_.vv.max(0.0).sqrt().matrix(); }
  /// Covariance of the residual of a measurement with this error at estimate() [m²].
  Matrix innovation_covariance(const Matrix& measurement) const {
    return measurement + Matrix(covariance_.xx.matrix().asDiagonal());
  }
  Matrix innovation_covariance() const { return innovation_covariance(nominal_covariance()); }
  const AxisCovariance<Axes>& covariance() const { return covariance_; }

 private:
  struct Scheduled {
    Gains gains;
    double interval = 1.0;
  };
  Matrix nominal_covariance() const { return errors_.sigma * errors_.sigma * Matrix::Identity(); }
  Scheduled scheduled() const;
  AxisGain<Axes> optimal_gain(const Axes& variance) const;
  Scheduled as_scheduled(const AxisGain<Axes>& gain) const;
  bool correct(const Vector& z, const Axes& variance, const AxisGain<Axes>& gain);
  bool refuse_measurement();

  GainSchedule schedule_;
  ErrorModel errors_;
  Kinematics<D> prior_;
  Kinematics<D> estimate_;
  AxisCovariance<Axes> covariance_;
  AxisCovariance<Axes> noise_;  // the same without process noise
  std::optional<Vector> residual_;
  Scheduled used_;
  double interval_;       // time of the last prediction
  double elapsed_ = 0.0;  // time since the last measurement used
  int updates_ = 0;
  int misses_ = 0;
  bool started_ = false;
  bool starting_up_ = true;
  Refusals refusals_;
};

extern template class GainFilter<1>;
extern template class GainFilter<2>;
extern template class GainFilter<3>;

/// "g=0.1 h=0.005 k=0.0001", as many gains as the order has, four digits each.
std::string to_text(const Gains& gains);

}  // namespace ghtrack

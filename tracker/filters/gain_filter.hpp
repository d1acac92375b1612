#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gain_schedule.hpp"
#include "tracker/filters/gains/gains.hpp"
#include "tracker/filters/implied_noise.hpp"
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
  double renewal = std::numeric_limits<double>::infinity();  // see process_noise() [s]
  double huber = std::numeric_limits<double>::infinity();    // longest residual used, in sigmas
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
/// Given gains are meant for the nominal interval. Where the schedule says
/// IrregularTime::kGainsFromCovariance, a scan at any other time and a second sensor at the same
/// instant, and with a Huber limit a residual beyond it, are met with the gains of the Kalman
/// filter whose process noise the given gains imply (implied_noise()), and with the measurement's
/// own error; the given gains return when that filter has settled and scans are on time again.
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
  GainFilter(const Gains& gains, double dt, const Kinematics<D>& guess, double sigma = 1.0,
             IrregularTime irregular_time = IrregularTime::kFixedGains);

  /// "order0", "gh" or "ghk".
  std::string_view name() const;
  /// "g=0.1 h=0.005".
  std::string gains_text() const;
  const Gains& steady_gains() const { return design_->schedule.steady; }
  double nominal_interval() const { return design_->schedule.interval; }
  double sigma() const { return design_->errors.sigma; }

  /// Takes the first measurement as the position; velocity and acceleration are unknown.
  bool start(const Vector& z, const Matrix& covariance);
  bool start(const Vector& z) { return start(z, nominal_covariance()); }

  /// Takes the first measurement as the position, and where nothing learns them at the start
  /// (StartUp::kNone) the derivatives as guessed.
  bool start_at(const Kinematics<D>& first);

  /// Takes a guess as certain and the start-up as done.
  void start_from(const Kinematics<D>& guess);

  /// Carries the state dt seconds on. @returns false if refused
  bool predict(double dt);

  /// Corrects the prediction with a measured position [m]; the first one starts the filter. Several
  /// at one instant count as their mean, weighted by their variances.
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
  Knowledge<D> knowledge() const {
    return {design_->schedule.steady.order, estimate_, covariance_};
  }

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
  Vector noise_sigma() const { return noise().xx.max(0.0).sqrt().matrix(); }
  /// The same of velocity_sigma().
  Vector noise_velocity_sigma() const { return noise().vv.max(0.0).sqrt().matrix(); }
  /// Covariance of the residual of a measurement with this error at estimate() [m²].
  Matrix innovation_covariance(const Matrix& measurement) const {
    return measurement + Matrix(covariance_.xx.matrix().asDiagonal());
  }
  Matrix innovation_covariance() const { return innovation_covariance(nominal_covariance()); }
  const AxisCovariance<Axes>& covariance() const { return covariance_; }

 private:
  /// What does not change: copies of a filter share it.
  struct Design {
    GainSchedule schedule;
    ErrorModel errors;
    bool has_belief = false;              // a table that may be left
    NoiseDensities implied = {};          // by its gains
    AxisCovariance<double> settled = {};  // what belief_ is while the steady gains are used

    Design(const GainSchedule& gains, const ErrorModel& model);
  };
  struct Scheduled {
    Gains gains;
    double interval = 1.0;
  };
  Matrix nominal_covariance() const {
    return design_->errors.sigma * design_->errors.sigma * Matrix::Identity();
  }
  Scheduled scheduled() const;
  Scheduled as_scheduled(const AxisGain<Axes>& gain) const;
  bool has_process_noise() const { return design_->errors.process_intensity > 0.0; }
  const AxisCovariance<Axes>& noise() const { return has_process_noise() ? noise_ : covariance_; }
  bool limits_residuals() const { return std::isfinite(design_->errors.huber); }
  bool is_steady() const { return on_schedule_ && !starting_up_; }
  bool doubts(const Vector& residual, const Axes& error, const Axes& variance);
  AxisCovariance<Axes> settled_belief() const;
  void carry_belief(double dt);
  void leave_schedule();
  void return_to_schedule();
  bool update_by_table(const Vector& z, const Axes& variance);
  bool update_at_same_instant(const Vector& z, const Axes& variance, bool is_doubtful);
  bool update_by(AxisCovariance<Axes>& belief, const Vector& z, const Axes& variance,
                 bool is_doubtful);
  bool correct(const Vector& z, const Axes& variance, const AxisGain<Axes>& gain);
  bool refuse_measurement();

  std::shared_ptr<const Design> design_;
  AxisCovariance<Axes> belief_;  // that the gains follow off the table and while starting up
  Kinematics<D> prior_;
  Kinematics<D> estimate_;
  AxisCovariance<Axes> covariance_;
  AxisCovariance<Axes> noise_;  // the same without process noise, if there is any
  std::optional<Vector> residual_;
  Scheduled used_;
  double interval_;       // time of the last prediction
  double elapsed_ = 0.0;  // time since the last measurement used
  // Covariance of the position with the state, were the gains of the last update the best ones.
  AxisGain<Axes> left_ = {Axes::Zero(), Axes::Zero(), Axes::Zero()};
  int updates_ = 0;
  int instants_ = 0;  // of updates
  int misses_ = 0;
  int far_in_a_row_ = 0;              // residuals beyond the Huber limit, on one side
  Vector last_far_ = Vector::Zero();  // the latest of them
  bool started_ = false;
  bool starting_up_ = true;
  bool on_schedule_ = true;  // the table's gains are due
  Refusals refusals_;
};

extern template class GainFilter<1>;
extern template class GainFilter<2>;
extern template class GainFilter<3>;

/// "g=0.1 h=0.005 k=0.0001", as many gains as the order has, four digits each.
std::string to_text(const Gains& gains);

}  // namespace ghtrack

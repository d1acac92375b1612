#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "sensors/measurement.hpp"
#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gains/gains.hpp"
#include "tracker/filters/kinematics.hpp"
#include "tracker/filters/motion.hpp"

namespace ghtrack {

/// How a filter carries a covariance through a function that is not linear.
enum class Propagation {
  kExtended,   // by its derivative at the mean (EKF)
  kUnscented,  // by 2n points √n sigmas from the mean, each of weight 1/2n (UKF with κ = 0; also
               // known as the cubature filter)
};

/// What such a filter assumes.
struct MotionModel {
  TargetMotion motion;
  Propagation propagation = Propagation::kExtended;
  double sigma = 1.0;          // of a measurement, per axis, unless an update says otherwise [m]
  double interval = 1.0;       // nominal time between updates [s]
  double initial_speed = 0.0;  // 1-sigma velocity per axis at first sight [m/s]
};

/// Extended or unscented Kalman filter of one object in the plane, for any motion and for
/// measurements of any model: what a radar or a camera measured is used as it is. On one axis, for
/// motions that need no plane and measured positions, it is the Kalman filter.
///
/// A value: copies are independent filters. Steps that cannot be used are refused, counted, and
/// leave the filter as it was.
template <int D>
class MotionFilter {
  static_assert(D == 1 || D == 2);

 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  /// @throws std::invalid_argument if the motion needs a plane, and D is 1
  explicit MotionFilter(const MotionModel& model);

  /// "ekf" or "ukf".
  std::string_view name() const;
  /// Those it settles at on a straight path with positions measured: "g=0.1 h=0.005".
  std::string gains_text() const;
  const Gains& steady_gains() const { return steady_; }
  double nominal_interval() const { return model_.interval; }
  double sigma() const { return model_.sigma; }
  const TargetMotion& motion() const { return model_.motion; }
  Propagation propagation() const { return model_.propagation; }

  bool start(const Vector& z, const Matrix& covariance);
  bool start(const Vector& z) { return start(z, nominal_covariance()); }
  /// Starts at a guess as uncertain as a target at first sight.
  void start_from(const Kinematics<D>& guess);
  bool predict(double dt);
  bool update(const Vector& z, const Matrix& covariance);
  bool update(const Vector& z) { return update(z, nominal_covariance()); }
  /// Corrects with what the sensor measured. The filter has been started.
  bool update(const Measurement& measured) requires(D == 2);
  void coast();

  bool is_started() const { return started_; }
  int updates() const { return updates_; }
  int consecutive_misses() const { return misses_; }
  const Refusals& refusals() const { return refusals_; }

  const Kinematics<D>& prior() const { return prior_; }
  const Kinematics<D>& estimate() const { return estimate_; }
  /// Of a measured position, z minus the predicted one [m]; of other measurements the correction
  /// that they made to the position.
  const std::optional<Vector>& residual() const { return residual_; }
  Vector position_sigma() const {
    return position_covariance().diagonal().cwiseMax(0.0).cwiseSqrt();
  }
  Matrix innovation_covariance(const Matrix& measurement) const {
    return measurement + position_covariance();
  }
  Matrix innovation_covariance() const { return innovation_covariance(nominal_covariance()); }
  /// ln N(r; 0, S) of the last update.
  double log_likelihood() const { return log_likelihood_; }

  const MotionState& state() const { return x_; }
  const MotionCovariance& covariance() const { return p_; }
  /// Goes on from what another filter knows at this instant; the rest stays as it is.
  void adopt(const Knowledge<D>& known);
  /// Without the covariances between the axes.
  Knowledge<D> knowledge() const;
  /// Goes on from another state at this instant.
  void set_state(const MotionState& state, const MotionCovariance& covariance);

 private:
  Matrix nominal_covariance() const { return model_.sigma * model_.sigma * Matrix::Identity(); }
  Matrix position_covariance() const {
    return started_ ? Matrix(p_.template topLeftCorner<D, D>()) : Matrix::Zero();
  }
  Kinematics<D> kinematics() const;
  bool has_velocity() const { return x_.size() >= 2 * D; }
  bool has_acceleration() const { return x_.size() == 3 * D; }
  bool refuse_measurement();
  bool correct(const MeasuredVector& residual, const MeasuredCovariance& s,
               const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 3>& cross,
               const std::optional<Vector>& residual_in_position);

  MotionModel model_;
  Gains steady_;
  MotionState x_;
  MotionCovariance p_;
  Kinematics<D> prior_;
  Kinematics<D> estimate_;
  std::optional<Vector> residual_;
  double log_likelihood_ = 0.0;
  int updates_ = 0;
  int misses_ = 0;
  bool started_ = false;
  Refusals refusals_;
};

extern template class MotionFilter<1>;
extern template class MotionFilter<2>;

}  // namespace ghtrack

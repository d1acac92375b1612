#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gains/gains.hpp"
#include "tracker/filters/kinematics.hpp"

namespace ghtrack {

/// What a Kalman filter assumes.
struct KalmanModel {
  double sigma = 1.0;     // of a measurement, per axis, unless an update says otherwise [m]
  double interval = 1.0;  // nominal time between updates [s], of the steady gains
  ProcessModel process_model = ProcessModel::kPiecewiseConstant;
  double process_intensity = 1.0;                            // see process_noise()
  double renewal = std::numeric_limits<double>::infinity();  // see process_noise() [s]
  double initial_speed = 0.0;         // 1-sigma velocity per axis at first sight [m/s]
  double initial_acceleration = 0.0;  // the same for the acceleration [m/s²]
  double huber = std::numeric_limits<double>::infinity();  // longest pull of a residual, in sigmas
};

/// Kalman filter of position measurements on D axes under constant velocity (Order 1) or constant
/// acceleration (Order 2). State: position, velocity[, acceleration], each with D components.
///
/// A value: copies are independent filters. Steps that cannot be used are refused, counted, and
/// leave the filter as it was. @ingroup gh_family
template <int Order, int D>
class KalmanFilter {
  static_assert(Order == 1 || Order == 2);

 public:
  static constexpr int kStates = (Order + 1) * D;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;
  using Covariance = Eigen::Matrix<double, kStates, kStates>;

  /// A filter that starts at its first measurement, at rest with the model's initial speed as its
  /// uncertainty.
  explicit KalmanFilter(const KalmanModel& model);
  /// A filter that starts from a guess.
  KalmanFilter(const KalmanModel& model, const Kinematics<D>& guess, const Covariance& covariance);

  /// "kalman-cv" or "kalman-ca".
  std::string_view name() const { return Order == 1 ? "kalman-cv" : "kalman-ca"; }
  /// The gains in the steady state: "g=0.1 h=0.005".
  std::string gains_text() const;
  const Gains& steady_gains() const { return steady_; }
  double nominal_interval() const { return model_.interval; }
  double sigma() const { return model_.sigma; }

  bool start(const Vector& z, const Matrix& covariance);
  bool start(const Vector& z) { return start(z, nominal_covariance()); }

  /// Starts at a guess as uncertain as a target at first sight.
  void start_from(const Kinematics<D>& guess);

  /// x' = F x, P' = F P Fᵀ + Q. @returns false if refused
  bool predict(double dt);

  /// S = H P' Hᵀ + R, K = P' Hᵀ S⁻¹, x = x' + K r, P = (I − K H) P' (I − K H)ᵀ + K R Kᵀ.
  /// The first measurement starts the filter.
  /// @param covariance  R of the measurement [m²], positive definite together with P
  /// @returns false if refused
  bool update(const Vector& z, const Matrix& covariance);
  bool update(const Vector& z) { return update(z, nominal_covariance()); }

  /// Says that there is no measurement for this prediction, although there should be.
  void coast();

  /// Goes on from what another filter knows at this instant; derivatives that it does not know are
  /// as uncertain as at first sight.
  void adopt(const Knowledge<D>& known);
  /// Without the covariances between the axes.
  Knowledge<D> knowledge() const;

  bool is_started() const { return started_; }
  int updates() const { return updates_; }
  int consecutive_misses() const { return misses_; }
  const Refusals& refusals() const { return refusals_; }

  const Kinematics<D>& prior() const { return prior_; }
  const Kinematics<D>& estimate() const { return estimate_; }
  const std::optional<Vector>& residual() const { return residual_; }
  /// Normalised innovation squared rᵀ S⁻¹ r of the last update.
  double nis() const { return nis_; }
  /// ln N(r; 0, S) of the last update.
  double log_likelihood() const;

  Vector position_sigma() const;
  Vector velocity_sigma() const;
  Matrix innovation_covariance(const Matrix& measurement) const;
  Matrix innovation_covariance() const { return innovation_covariance(nominal_covariance()); }
  const Covariance& covariance() const { return covariance_; }

 private:
  Matrix nominal_covariance() const { return model_.sigma * model_.sigma * Matrix::Identity(); }
  bool refuse_measurement();

  KalmanModel model_;
  Gains steady_;
  Kinematics<D> prior_;
  Kinematics<D> estimate_;
  Covariance covariance_ = Covariance::Zero();
  std::optional<Vector> residual_;
  double nis_ = 0.0;
  double determinant_ = 1.0;  // of S at the last update
  int updates_ = 0;
  int misses_ = 0;
  bool started_ = false;
  Refusals refusals_;
};

extern template class KalmanFilter<1, 1>;
extern template class KalmanFilter<1, 2>;
extern template class KalmanFilter<1, 3>;
extern template class KalmanFilter<2, 1>;
extern template class KalmanFilter<2, 2>;
extern template class KalmanFilter<2, 3>;

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "sensors/detection.hpp"
#include "tracker/filters/filter_config.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/imm_filter.hpp"
#include "tracker/filters/kalman_filter.hpp"
#include "tracker/filters/multiple_model.hpp"

namespace ghtrack {

/// A filter of one object's positions in the plane. A value that can be copied; every operation
/// leaves its numbers finite, inputs that it cannot use are refused and counted.
template <class F>
concept PlanarFilter = std::copyable<F> &&
    requires(F filter, const F& constant, double dt, const Eigen::Vector2d& z,
             const Eigen::Matrix2d& covariance) {
  { filter.start(z, covariance) } -> std::same_as<bool>;
  { filter.predict(dt) } -> std::same_as<bool>;
  { filter.update(z, covariance) } -> std::same_as<bool>;
  { filter.update(z) } -> std::same_as<bool>;
  filter.coast();
  { constant.is_started() } -> std::same_as<bool>;
  { constant.updates() } -> std::same_as<int>;
  { constant.consecutive_misses() } -> std::same_as<int>;
  { constant.refusals() } -> std::convertible_to<Refusals>;
  { constant.prior() } -> std::convertible_to<Kinematics<2>>;
  { constant.estimate() } -> std::convertible_to<Kinematics<2>>;
  { constant.residual() } -> std::convertible_to<std::optional<Eigen::Vector2d>>;
  { constant.position_sigma() } -> std::convertible_to<Eigen::Vector2d>;
  { constant.innovation_covariance(covariance) } -> std::convertible_to<Eigen::Matrix2d>;
  { constant.name() } -> std::convertible_to<std::string_view>;
};

/// What is known beside it of a filter that settles at constant gains: lag, noise and stability are
/// those of its gains, see gains/analysis.hpp.
template <class F>
concept SettlesAtGains = requires(const F& filter) {
  { filter.steady_gains() } -> std::convertible_to<Gains>;
  { filter.gains_text() } -> std::convertible_to<std::string>;
  { filter.sigma() } -> std::convertible_to<double>;
  { filter.nominal_interval() } -> std::convertible_to<double>;
};

template <class Variant>
inline constexpr bool all_are_planar_filters = false;
template <class... Fs>
inline constexpr bool all_are_planar_filters<std::variant<Fs...>> = (PlanarFilter<Fs> && ...);

/// One object's filter.
using Filter = std::variant<GainFilter<2>, KalmanFilter<1, 2>, KalmanFilter<2, 2>, MotionFilter<2>,
                            MultipleModelFilter<2>, ImmFilter<2>>;
static_assert(all_are_planar_filters<Filter>,
              "every alternative of Filter needs the operations of PlanarFilter");

/// A filter that waits for its first measurement. Make one per configuration and copy it for each
/// new track: the gains are designed here.
/// @param sigma  1-sigma measurement error per axis [m], > 0
/// @param dt     nominal time between updates [s], > 0
/// @throws std::invalid_argument if σ or dt is not positive and finite, or the gains are unstable
Filter make_filter(const FilterConfig& config, double sigma, double dt);

// The operations of whichever filter it is; see GainFilter.

bool start(Filter& filter, const Eigen::Vector2d& z, const Eigen::Matrix2d& covariance);
bool predict(Filter& filter, double dt);
bool update(Filter& filter, const Eigen::Vector2d& z);
bool update(Filter& filter, const Eigen::Vector2d& z, const Eigen::Matrix2d& covariance);
/// With what the sensor measured, by filters that can make use of it; the others take the position,
/// and do not look at it.
bool update(Filter& filter, const Eigen::Vector2d& z, const Eigen::Matrix2d& covariance,
            const std::optional<Measurement>& measured);
bool update(Filter& filter, const Detection& detection);
/// ln N(r; 0, S) of the residual that this measurement has at estimate(), S as in
/// innovation_covariance(); nothing if S is singular.
std::optional<double> log_likelihood(const Filter& filter, const Eigen::Vector2d& z,
                                     const Eigen::Matrix2d& covariance);
void coast(Filter& filter);

bool is_started(const Filter& filter);
int updates(const Filter& filter);
int consecutive_misses(const Filter& filter);
Refusals refusals(const Filter& filter);

/// The state before the last update, and after it.
const Kinematics<2>& prior(const Filter& filter);
const Kinematics<2>& estimate(const Filter& filter);
/// Measured minus predicted position of the last update [m]; nothing after a prediction.
const std::optional<Eigen::Vector2d>& residual(const Filter& filter);
/// Predicted 1-sigma error of the estimated position per axis [m]; after predict() of the
/// predicted position.
Eigen::Vector2d position_sigma(const Filter& filter);
/// What is left of it when the target moves exactly as the filter assumes, per axis [m]; of several
/// models as the leading one assumes. A Kalman filter cannot tell: its error and its allowance for
/// manoeuvres are one.
Eigen::Vector2d noise_sigma(const Filter& filter);
/// Covariance of the position's error: before update() of the predicted one [m²].
Eigen::Matrix2d position_covariance(const Filter& filter);
/// Covariance of the residual that a measurement would have after predict() [m²].
Eigen::Matrix2d innovation_covariance(const Filter& filter, const Eigen::Matrix2d& measurement);
Eigen::Matrix2d innovation_covariance(const Filter& filter);

/// Such as "gh"; of several models the leading one's.
std::string_view name(const Filter& filter);
/// Of several models the name of the leading one, such as "ball"; empty for a single filter.
std::string_view model_name(const Filter& filter);
/// The filter with designed gains that leads, if it is one: only those have a lag apart from their
/// predicted error.
const GainFilter<2>* designed_gain_filter(const Filter& filter);
/// Such as "g=0.1 h=0.005"; for a Kalman filter the gains that it settles at; empty if the filter
/// does not settle.
std::string gains_text(const Filter& filter);
/// Both, such as "gh g=0.1 h=0.005"; of several models "multiple-model" or "imm", whichever leads.
std::string title(const Filter& filter);
/// Nothing if the filter does not settle.
std::optional<Gains> steady_gains(const Filter& filter);

/// Steady error truth − estimate on one axis without noise, under a lasting velocity (order 0),
/// acceleration (order 1) or jerk (order 2), see steady_lag(Gains, …).
std::optional<Lag> steady_lag(const Filter& filter, double next_derivative);
/// √(noise² + lag²) of the filtered position on one axis in the steady state.
std::optional<double> predicted_rmse(const Filter& filter, double next_derivative);

}  // namespace ghtrack

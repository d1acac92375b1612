#pragma once

#include <Eigen/Core>
#include <limits>

#include "tracker/filters/gains/rules.hpp"
#include "tracker/filters/kinematics.hpp"

namespace ghtrack {

/// Symmetric error covariance of position x, velocity v and acceleration a on one axis; with an
/// array as Number, on several independent axes at once.
template <class Number>
struct AxisCovariance {
  Number xx, xv, xa, vv, va, aa;

  AxisCovariance& operator+=(const AxisCovariance& other) {
    xx += other.xx, xv += other.xv, xa += other.xa;
    vv += other.vv, va += other.va, aa += other.aa;
    return *this;
  }
};

/// What one filter knows of an object, for another one to go on from.
template <int D>
struct Knowledge {
  int order = 0;  // highest derivative that is known
  Kinematics<D> state;
  AxisCovariance<Eigen::Array<double, D, 1>> covariance;  // of the derivatives up to `order`
};

/// What a residual is multiplied by: x += r·x, v += r·v, a += r·a.
template <class Number>
struct AxisGain {
  Number x, v, a;
};

/// F P Fᵀ for motion under constant acceleration during dt.
template <class Number>
AxisCovariance<Number> extrapolated(const AxisCovariance<Number>& p, double dt) {
  const double half = 0.5 * dt * dt;
  AxisCovariance<Number> out;
  out.aa = p.aa;
  out.va = p.va + dt * p.aa;
  out.vv = p.vv + dt * (p.va + out.va);
  out.xa = p.xa + dt * p.va + half * p.aa;
  out.xv = p.xv + dt * p.vv + half * p.va + dt * out.xa;
  out.xx = p.xx + dt * (2.0 * p.xv + dt * p.vv) + half * (2.0 * (p.xa + dt * p.va) + half * p.aa);
  return out;
}

/// (I − K H) P (I − K H)ᵀ + K r Kᵀ: the error after a correction with any gain, optimal or not.
/// @param r  variance of the measurement
template <class Number>
AxisCovariance<Number> corrected(const AxisCovariance<Number>& p, const AxisGain<Number>& gain,
                                 const Number& r) {
  const Number keep = 1.0 - gain.x;
  const Number xv = p.xv - gain.v * p.xx;
  const Number xa = p.xa - gain.a * p.xx;
  AxisCovariance<Number> out;
  out.xx = keep * keep * p.xx + gain.x * gain.x * r;
  out.xv = keep * xv + gain.x * gain.v * r;
  out.xa = keep * xa + gain.x * gain.a * r;
  out.vv = p.vv - gain.v * (p.xv + xv) + gain.v * gain.v * r;
  out.va = p.va - gain.v * p.xa - gain.a * xv + gain.v * gain.a * r;
  out.aa = p.aa - gain.a * (p.xa + xa) + gain.a * gain.a * r;
  return out;
}

/// Uncertainty that a step of length dt adds on one axis.
///
/// The random acceleration of kPiecewiseConstant and the jumps of kRandomWalk are drawn anew every
/// `renewal` seconds: a step of n renewals, n ≥ 1, adds as much as n steps of one renewal, and a
/// shorter one its share, so that the error grows alike however a time is cut. With an infinite
/// renewal they are drawn anew at every step, whatever its length, as textbooks have it.
/// @param order      highest derivative of the filter: 0, 1 or 2
/// @param intensity  kPiecewiseConstant, kRandomWalk: 1-sigma acceleration for orders 0 and 1,
///                   1-sigma change of acceleration per step for order 2 [m/s²];
///                   kWhiteNoise: spectral density of the first derivative that the filter does
///                   not carry [m²/s, m²/s³, m²/s⁵]
/// @param renewal    [s]; white noise has none
AxisCovariance<double> process_noise(ProcessModel model, int order, double intensity, double dt,
                                     double renewal = std::numeric_limits<double>::infinity());

/// The intensity for which a filter has tracking index λ at step dt.
double intensity_of_index(ProcessModel model, double index, double sigma, double dt);

/// Error covariance before an update of the Kalman filter that has settled: the solution P of
/// P = F (P − P Hᵀ (H P Hᵀ + r)⁻¹ H P) Fᵀ + Q, by doubling the number of steps until it stays
/// (Chu, Fan, Lin & Wang, Int. J. Control 77, 2004, algorithm SDA).
/// @param q      what a step adds
/// @param order  highest derivative of the filter: 0, 1 or 2
/// @param r      variance of the measurement [m²], > 0
/// @param dt     of a step [s], > 0
AxisCovariance<double> settled_prediction(const AxisCovariance<double>& q, int order, double r,
                                          double dt);

/// Gains of the Kalman filter in the steady state.
Gains steady_kalman_gains(ProcessModel model, int order, double intensity, double sigma, double dt);

}  // namespace ghtrack

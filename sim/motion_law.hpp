#pragma once

#include <Eigen/Core>
#include <functional>

namespace ghtrack {

/// The law of a motion that is random by design, where it is linear and its noise normal:
///   s(t + dt) = F(dt) s(t) + w,   w ~ N(0, Q(dt)) and independent of all before,
/// about a mean that is known, such as a plan or a parabola, and does not matter to what cannot be
/// known. The first two numbers of s are the position [m], the next two the velocity [m/s], each
/// along x and y; what else there is, such as an acceleration, is the motion's own affair.
///
/// From it follows the least error that any filter can have: see posterior_bound.hpp. A regime that
/// moves by such a law offers
///   std::optional<MotionLaw> law(const EnvironmentConfig& environment) const
/// and says nothing where the law does not hold exactly, for then a bound would be none.
struct MotionLaw {
  static constexpr int kMostNumbers = 8;
  using Matrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostNumbers, kMostNumbers>;

  Matrix start;                              // covariance of s when the object appears
  std::function<Matrix(double)> transition;  // F over a time [s]
  std::function<Matrix(double)> noise;       // Q over a time [s]
  bool holds_alone = false;                  // and not where others may push the object
  bool takes_any_start = false;              // other velocities on both axes do what F says
};

/// Motion under forces that are known, without noise: F of constant velocity. It is as random as
/// its start.
MotionLaw drifting();

/// A stochastic differential equation ds = A s dt + dW with E[dW dWᵀ] = W dt, solved exactly over
/// any time (Van Loan 1978, "Computing integrals involving the matrix exponential").
/// @param a  A, square, at most 8 numbers
/// @param w  W, symmetric, of the same size
MotionLaw driven(const MotionLaw::Matrix& a, const MotionLaw::Matrix& w);

}  // namespace ghtrack

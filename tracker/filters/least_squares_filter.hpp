#pragma once

#include <array>
#include <optional>

#include "tracker/filters/gains/polynomial_memory.hpp"
#include "tracker/filters/gains/rules.hpp"
#include "tracker/filters/kinematics.hpp"

namespace ghtrack {

/// Growing memory: the least-squares polynomial of order 0, 1 or 2 through all measurements so
/// far, updated one by one (Zarchan & Musoff). It forgets its initial guess, zero by default, with
/// measurement order + 1; before that its derivatives mean nothing. Measurements are assumed to be
/// equally spaced: after a miss or an uneven step the fit is approximate. @ingroup gh_family
template <int D>
class LeastSquaresFilter {
 public:
  using Vector = typename Kinematics<D>::Vector;

  /// @param dt     time between measurements [s], > 0
  /// @param sigma  1-sigma measurement error, for errors()
  LeastSquaresFilter(int order, double dt, double sigma = 1.0, const Kinematics<D>& guess = {});

  /// Carries the state dt seconds on. @returns false if refused
  bool predict(double dt);
  bool predict() { return predict(dt_); }
  /// Takes one more measurement into the fit. @returns false if refused
  bool update(const Vector& z);
  /// Says that there is no measurement for this prediction.
  void coast() { residual_.reset(); }
  /// Forgets everything.
  void reset();

  int updates() const { return updates_; }
  const Kinematics<D>& prior() const { return prior_; }
  const Kinematics<D>& estimate() const { return estimate_; }
  const std::optional<Vector>& residual() const { return residual_; }
  const Refusals& refusals() const { return refusals_; }
  /// Gains of the last update.
  const Gains& used_gains() const { return used_; }
  /// 1-sigma errors of position, velocity and acceleration after the last update.
  std::array<double, 3> errors() const;

 private:
  int order_;
  double dt_;
  double sigma_;
  Kinematics<D> guess_;
  Kinematics<D> prior_ = guess_;
  Kinematics<D> estimate_ = guess_;
  std::optional<Vector> residual_ = {};
  Gains used_ = {};
  int updates_ = 0;
  Refusals refusals_ = {};
};

extern template class LeastSquaresFilter<1>;
extern template class LeastSquaresFilter<2>;
extern template class LeastSquaresFilter<3>;

}  // namespace ghtrack

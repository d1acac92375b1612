#pragma once

#include <array>
#include <optional>

#include "tracker/filters/gains/polynomial_memory.hpp"
#include "tracker/filters/gains/rules.hpp"
#include "tracker/filters/kinematics.hpp"

namespace ghtrack {

/// Growing memory: the least-squares polynomial of order 0, 1 or 2 through all measurements so
/// far, updated one by one. It forgets its initial guess, zero by default, with measurement
/// order + 1; before that its derivatives mean nothing.
///
/// While measurements are dt apart the gains are the closed ones of Zarchan & Musoff. From the
/// first miss or uneven step on they come from the times themselves: with τ the time of a
/// measurement after now and N = Σ φ φᵀ, φ = (1, τ, τ²/2)ᵀ, over all of them, the latest included,
/// the gain of its residual is the first column of N⁻¹. @ingroup gh_family
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
  /// Takes the first measurement as the position, with the guess's derivatives.
  bool start(const Vector& z);
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
  std::array<double, 5> moments_ = {};  // Σ τⁱ of all measurements, τ ≤ 0 their time after now [sⁱ]
  double elapsed_ = 0.0;                // since the latest measurement
  bool is_even_ = true;                 // measurements have been dt apart
  int updates_ = 0;
  Refusals refusals_ = {};
};

extern template class LeastSquaresFilter<1>;
extern template class LeastSquaresFilter<2>;
extern template class LeastSquaresFilter<3>;

}  // namespace ghtrack

#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracker/filters/mode_chain.hpp"
#include "tracker/filters/motion_filter.hpp"

namespace ghtrack {

/// Interacting multiple models (Blom & Bar-Shalom 1988): filters side by side for a target that
/// changes how it moves, as a Markov chain with p_ij from mode i to j. Every step
///   mixes     c_j = Σ p_ij μ_i,  μ_i|j = p_ij μ_i / c_j,  x_0j = Σ μ_i|j x_i,
///             P_0j = Σ μ_i|j (P_i + (x_i − x_0j)(x_i − x_0j)ᵀ)
///   filters   each mode from its own mixture, with likelihood Λ_j = N(r_j; 0, S_j)
///   weighs    μ_j ∝ c_j Λ_j
/// and combines the modes to one mean and covariance; when modes are mixed, see ModeChain. A
/// prediction starts at the last measurement, however many predictions have been made since: time
/// is the same however it is cut. Modes may have different states, down to the position alone: what
/// mode i does not know of mode j's state, mode j keeps of its own (unbiased mixing, Yuan, Han,
/// Duan & Lei 2012). It settles at no gains: they follow the weights.
///
/// A value: copies are independent filters. Steps that cannot be used are refused, counted, and
/// leave the filter as it was.
template <int D>
class ImmFilter {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  struct Mode {
    std::string name;
    MotionFilter<D> filter;
    double weight = 1.0;  // μ, probability that the target moves like this
  };

  /// @param modes      waiting for their first measurement; equally likely, whatever their weights
  /// @param switching  probability that the target changes its mode in one nominal interval; to
  ///                   each of the others alike. In other times by the same chain in continuous
  ///                   time.
  /// @throws std::invalid_argument without a mode, or unless 0 ≤ switching ≤ 1/2
  ImmFilter(std::vector<Mode> modes, double switching);

  const std::vector<Mode>& modes() const { return modes_; }
  /// The likeliest mode.
  const Mode& leader() const { return modes_[leader_]; }

  std::string_view name() const { return "imm"; }
  double sigma() const { return leader().filter.sigma(); }

  bool start(const Vector& z, const Matrix& covariance);
  bool start(const Vector& z) { return start(z, nominal_covariance()); }
  /// Starts at a guess as uncertain as a target at first sight.
  void start_from(const Kinematics<D>& guess);
  bool predict(double dt);
  bool update(const Vector& z, const Matrix& covariance);
  bool update(const Vector& z) { return update(z, nominal_covariance()); }
  bool update(const Measurement& measured) requires(D == 2);
  void coast();

  bool is_started() const { return leader().filter.is_started(); }
  int updates() const { return updates_; }
  int consecutive_misses() const { return misses_; }
  const Refusals& refusals() const { return refusals_; }

  const Kinematics<D>& prior() const { return prior_; }
  const Kinematics<D>& estimate() const { return estimate_; }
  const std::optional<Vector>& residual() const { return residual_; }
  Vector position_sigma() const { return covariance_.diagonal().cwiseMax(0.0).cwiseSqrt(); }
  Matrix innovation_covariance(const Matrix& measurement) const {
    return measurement + covariance_;
  }
  Matrix innovation_covariance() const { return innovation_covariance(nominal_covariance()); }
  /// ln Σ c_j Λ_j of the last update.
  double log_likelihood() const { return log_likelihood_; }

 private:
  Matrix nominal_covariance() const { return sigma() * sigma() * Matrix::Identity(); }
  template <class UpdateMode>
  bool update_modes(const UpdateMode& update_mode, double error);
  void mix();
  void weigh();
  double widest_variance() const;
  void combine();
  bool is_finite() const { return estimate_.is_finite() && covariance_.allFinite(); }

  std::vector<Mode> modes_;
  std::vector<Mode> measured_;  // the modes after the last measurement, if predicted since
  ModeChain chain_;
  std::size_t leader_ = 0;
  Kinematics<D> prior_;
  Kinematics<D> estimate_;
  Matrix covariance_ = Matrix::Zero();  // of the position
  std::optional<Vector> residual_;
  double log_likelihood_ = 0.0;
  int updates_ = 0;
  int misses_ = 0;
  Refusals refusals_;
};

extern template class ImmFilter<1>;
extern template class ImmFilter<2>;

}  // namespace ghtrack

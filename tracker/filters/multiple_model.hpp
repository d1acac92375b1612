#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/kalman_filter.hpp"
#include "tracker/filters/mode_chain.hpp"
#include "tracker/filters/motion_filter.hpp"

namespace ghtrack {

/// One filter of one object's positions on D axes. Add yours here.
template <int D>
using SingleFilter =
    std::variant<GainFilter<D>, KalmanFilter<1, D>, KalmanFilter<2, D>, MotionFilter<D>>;

/// Several filters side by side on the measurements of one object; each keeps its own state, and
/// the innovations r decide which of them to believe (multiple-model estimation, Magill 1965, with
/// a target that may change its model as in Bar-Shalom, Li & Kirubarajan 2001, ch. 11):
///   μ' = (1 − p) μ + p (1 − μ) / (M − 1)          before each measurement
///   μ ∝ μ' N(r; 0, S)                              with each filter's own r and S
/// with p for the time since it was last done, see ModeChain. Then, before the next prediction, a
/// filter whose weight comes from the change (second term) rather than from its own past (first
/// term) goes on from the leader's state: of the two pasts the likelier one is kept, where an
/// interacting multiple model (Blom & Bar-Shalom 1988) would mix them, for which given gains have
/// no rule.
///
/// The filter with the largest weight μ leads: its state is the estimate. What the others predict
/// elsewhere is uncertainty: the covariance about the leader is Σ μ (P + d dᵀ), with d the distance
/// from the leader's position.
///
/// A value: copies are independent filters. Steps that cannot be used are refused, counted, and
/// leave the filter as it was.
template <int D>
class MultipleModelFilter {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  struct Model {
    std::string name;
    SingleFilter<D> filter;
    double weight = 1.0;  // probability that the target moves as this filter assumes
  };

  /// @param models     waiting for their first measurement; equally likely, whatever their weights
  /// @param switching  p, probability that the target changes its model in one nominal interval
  /// @throws std::invalid_argument without a model, or unless 0 ≤ p ≤ 1/2
  MultipleModelFilter(std::vector<Model> models, double switching);

  const std::vector<Model>& models() const { return models_; }
  const Model& leader() const { return models_[leader_]; }

  /// Of the leader.
  std::string_view name() const;
  std::string gains_text() const;
  const Gains& steady_gains() const;
  double nominal_interval() const;
  double sigma() const;

  bool start(const Vector& z, const Matrix& covariance);
  bool start(const Vector& z) { return start(z, nominal_covariance()); }
  /// Starts all filters from a guess, each as it does alone.
  void start_from(const Kinematics<D>& guess);
  bool predict(double dt);
  bool update(const Vector& z, const Matrix& covariance);
  bool update(const Vector& z) { return update(z, nominal_covariance()); }
  void coast();

  bool is_started() const;
  int updates() const;
  int consecutive_misses() const;
  const Refusals& refusals() const { return refusals_; }

  const Kinematics<D>& prior() const;
  const Kinematics<D>& estimate() const;
  const std::optional<Vector>& residual() const;
  Vector position_sigma() const { return covariance().diagonal().cwiseMax(0.0).cwiseSqrt(); }
  Vector noise_sigma() const;
  Matrix innovation_covariance(const Matrix& measurement) const {
    return measurement + covariance();
  }
  Matrix innovation_covariance() const { return innovation_covariance(nominal_covariance()); }

 private:
  Matrix nominal_covariance() const { return sigma() * sigma() * Matrix::Identity(); }
  Matrix covariance() const;
  double arriving(const Model& model, double leaving) const;
  double widest_variance() const;
  void follow_the_leader();
  void share_weights();
  std::vector<double> weights_after(const Vector& z, const Matrix& covariance) const;
  void elect();

  std::vector<Model> models_;
  ModeChain chain_;
  std::size_t leader_ = 0;
  Refusals refusals_;
};

extern template class MultipleModelFilter<1>;
extern template class MultipleModelFilter<2>;

}  // namespace ghtrack

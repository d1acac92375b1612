#include "tracker/filters/multiple_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

template <int D>
const Kinematics<D>& estimate_of(const SingleFilter<D>& filter) {
  return std::visit([](const auto& f) -> const Kinematics<D>& { return f.estimate(); }, filter);
}

template <int D>
Eigen::Matrix<double, D, D> innovation_covariance_of(const SingleFilter<D>& filter,
                                                     const typename GainFilter<D>::Matrix& r) {
  return std::visit([&](const auto& f) { return f.innovation_covariance(r); }, filter);
}

/// ln N(z − x; 0, S) without the constant that all filters share.
template <int D>
double log_likelihood(const SingleFilter<D>& filter, const Eigen::Matrix<double, D, 1>& z,
                      const Eigen::Matrix<double, D, D>& covariance) {
  const Eigen::Matrix<double, D, 1> residual = z - estimate_of(filter).position;
  const Eigen::Matrix<double, D, D> s = innovation_covariance_of(filter, covariance);
  const double nis = residual.dot(s.inverse() * residual);
  return -0.5 * (nis + portable::log(s.determinant()));
}

template <int D>
double interval_of(const SingleFilter<D>& filter) {
  return std::visit([](const auto& f) { return f.nominal_interval(); }, filter);
}

template <int D>
double sigma_of(const SingleFilter<D>& filter) {
  return std::visit([](const auto& f) { return f.sigma(); }, filter);
}

template <class Model>
double staying(const Model& model, double leaving) {
  return (1.0 - leaving) * model.weight;
}

}  // namespace

template <int D>
MultipleModelFilter<D>::MultipleModelFilter(std::vector<Model> models, double switching)
    : models_(std::move(models)),
      chain_(models_.size(), switching, models_.empty() ? 1.0 : interval_of(models_.front().filter),
             models_.empty() ? 1.0 : sigma_of(models_.front().filter), D) {
  share_weights();
}

template <int D>
std::string_view MultipleModelFilter<D>::name() const {
  return std::visit([](const auto& f) { return f.name(); }, leader().filter);
}

template <int D>
std::string MultipleModelFilter<D>::gains_text() const {
  return std::visit([](const auto& f) { return f.gains_text(); }, leader().filter);
}

template <int D>
const Gains& MultipleModelFilter<D>::steady_gains() const {
  return std::visit([](const auto& f) -> const Gains& { return f.steady_gains(); },
                    leader().filter);
}

template <int D>
double MultipleModelFilter<D>::nominal_interval() const {
  return interval_of(leader().filter);
}

template <int D>
double MultipleModelFilter<D>::sigma() const {
  return sigma_of(leader().filter);
}

template <int D>
bool MultipleModelFilter<D>::start(const Vector& z, const Matrix& covariance) {
  bool started = true;
  for (Model& model : models_) {
    started = std::visit([&](auto& f) { return f.start(z, covariance); }, model.filter) && started;
  }
  if (!started) {
    ++refusals_.measurements;
    return false;
  }
  share_weights();
  chain_.start(widest_variance());
  leader_ = 0;
  return true;
}

template <int D>
void MultipleModelFilter<D>::start_from(const Kinematics<D>& guess) {
  if (!start(guess.position)) return;
  for (Model& model : models_) std::visit([&](auto& f) { f.start_from(guess); }, model.filter);
}

template <int D>
bool MultipleModelFilter<D>::predict(double dt) {
  if (is_started() && dt > 0.0 && std::isfinite(dt)) {
    if (chain_.elapsed() == 0.0 && chain_.is_due()) follow_the_leader();
    chain_.predict(dt);
  }
  bool predicted = false;
  for (Model& model : models_) {
    predicted = std::visit([dt](auto& f) { return f.predict(dt); }, model.filter) || predicted;
  }
  if (!predicted) ++refusals_.times;
  return predicted;
}

template <int D>
bool MultipleModelFilter<D>::update(const Vector& z, const Matrix& covariance) {
  if (!is_started()) return start(z, covariance);
  if (!z.allFinite() || !covariance.allFinite()) {
    ++refusals_.measurements;
    return false;
  }
  const std::vector<double> weights = weights_after(z, covariance);
  bool used = false;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    used = std::visit([&](auto& f) { return f.update(z, covariance); }, models_[i].filter) || used;
    models_[i].weight = weights[i];
  }
  if (!used) ++refusals_.measurements;
  chain_.update(widest_variance(), covariance.trace());
  elect();
  return used;
}

template <int D>
void MultipleModelFilter<D>::coast() {
  for (Model& model : models_) std::visit([](auto& f) { f.coast(); }, model.filter);
}

template <int D>
bool MultipleModelFilter<D>::is_started() const {
  return std::visit([](const auto& f) { return f.is_started(); }, leader().filter);
}

template <int D>
int MultipleModelFilter<D>::updates() const {
  return std::visit([](const auto& f) { return f.updates(); }, leader().filter);
}

template <int D>
int MultipleModelFilter<D>::consecutive_misses() const {
  return std::visit([](const auto& f) { return f.consecutive_misses(); }, leader().filter);
}

template <int D>
const Kinematics<D>& MultipleModelFilter<D>::prior() const {
  return std::visit([](const auto& f) -> const Kinematics<D>& { return f.prior(); },
                    leader().filter);
}

template <int D>
const Kinematics<D>& MultipleModelFilter<D>::estimate() const {
  return estimate_of(leader().filter);
}

template <int D>
auto MultipleModelFilter<D>::residual() const -> const std::optional<Vector>& {
  return std::visit([](const auto& f) -> const std::optional<Vector>& { return f.residual(); },
                    leader().filter);
}

template <int D>
auto MultipleModelFilter<D>::noise_sigma() const -> Vector {
  if (const auto* gains = std::get_if<GainFilter<D>>(&leader().filter)) {
    return gains->noise_sigma();
  }
  return std::visit([](const auto& f) -> Vector { return f.position_sigma(); }, leader().filter);
}

template <int D>
auto MultipleModelFilter<D>::covariance() const -> Matrix {
  Matrix sum = Matrix::Zero();
  for (const Model& model : models_) {
    const Vector d = estimate_of(model.filter).position - estimate().position;
    sum += model.weight *
           (innovation_covariance_of(model.filter, Matrix::Zero()) + Matrix(d * d.transpose()));
  }
  return sum;
}

/// Weight that a model gets from those that the target gives up.
template <int D>
double MultipleModelFilter<D>::arriving(const Model& model, double leaving) const {
  if (models_.size() == 1) return 0.0;
  return leaving * (1.0 - model.weight) / static_cast<double>(models_.size() - 1);
}

/// The largest variance that a model takes the position to have.
template <int D>
double MultipleModelFilter<D>::widest_variance() const {
  double widest = 0.0;
  for (const Model& model : models_) {
    widest = std::max(widest, innovation_covariance_of(model.filter, Matrix::Zero()).trace());
  }
  return widest;
}

template <int D>
void MultipleModelFilter<D>::follow_the_leader() {
  const Knowledge<D> known =
      std::visit([](const auto& f) { return f.knowledge(); }, leader().filter);
  const double left = chain_.has_left();
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const Model& model = models_[i];
    if (i == leader_ || arriving(model, left) <= staying(model, left)) continue;
    std::visit([&](auto& f) { f.adopt(known); }, models_[i].filter);
  }
}

template <int D>
void MultipleModelFilter<D>::share_weights() {
  for (Model& model : models_) model.weight = 1.0 / static_cast<double>(models_.size());
}

template <int D>
std::vector<double> MultipleModelFilter<D>::weights_after(const Vector& z,
                                                          const Matrix& covariance) const {
  std::vector<double> weights;
  for (const Model& model : models_) {
    weights.push_back(log_likelihood(model.filter, z, covariance));
  }
  const double best = *std::max_element(weights.begin(), weights.end());
  const double leaving = chain_.leaving();
  double sum = 0.0;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const double prior = staying(models_[i], leaving) + arriving(models_[i], leaving);
    weights[i] = prior * portable::exp(weights[i] - best);
    sum += weights[i];
  }
  const bool is_usable = sum > 0.0 && std::isfinite(sum);
  for (std::size_t i = 0; i < models_.size(); ++i) {
    weights[i] = is_usable ? weights[i] / sum : models_[i].weight;
  }
  return weights;
}

/// The leader stays while no other is more likely.
template <int D>
void MultipleModelFilter<D>::elect() {
  for (std::size_t i = 0; i < models_.size(); ++i) {
    if (models_[i].weight > models_[leader_].weight) leader_ = i;
  }
}

template class MultipleModelFilter<1>;
template class MultipleModelFilter<2>;

}  // namespace ghtrack

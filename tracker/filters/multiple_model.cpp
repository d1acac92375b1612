#include "tracker/filters/multiple_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

const Kinematics<2>& estimate_of(const SingleFilter& filter) {
  return std::visit([](const auto& f) -> const Kinematics<2>& { return f.estimate(); }, filter);
}

Eigen::Matrix2d innovation_covariance_of(const SingleFilter& filter, const Eigen::Matrix2d& r) {
  return std::visit([&](const auto& f) { return f.innovation_covariance(r); }, filter);
}

/// ln N(z − x; 0, S) without the constant that all filters share.
double log_likelihood(const SingleFilter& filter, const Eigen::Vector2d& z,
                      const Eigen::Matrix2d& covariance) {
  const Eigen::Vector2d residual = z - estimate_of(filter).position;
  const Eigen::Matrix2d s = innovation_covariance_of(filter, covariance);
  const double nis = residual.dot(s.inverse() * residual);
  return -0.5 * (nis + portable::log(s.determinant()));
}

double interval_of(const SingleFilter& filter) {
  return std::visit([](const auto& f) { return f.nominal_interval(); }, filter);
}

double sigma_of(const SingleFilter& filter) {
  return std::visit([](const auto& f) { return f.sigma(); }, filter);
}

double staying(const MultipleModelFilter::Model& model, double leaving) {
  return (1.0 - leaving) * model.weight;
}

}  // namespace

MultipleModelFilter::MultipleModelFilter(std::vector<Model> models, double switching)
    : models_(std::move(models)),
      chain_(models_.size(), switching, models_.empty() ? 1.0 : interval_of(models_.front().filter),
             models_.empty() ? 1.0 : sigma_of(models_.front().filter)) {
  share_weights();
}

std::string_view MultipleModelFilter::name() const {
  return std::visit([](const auto& f) { return f.name(); }, leader().filter);
}

std::string MultipleModelFilter::gains_text() const {
  return std::visit([](const auto& f) { return f.gains_text(); }, leader().filter);
}

const Gains& MultipleModelFilter::steady_gains() const {
  return std::visit([](const auto& f) -> const Gains& { return f.steady_gains(); },
                    leader().filter);
}

double MultipleModelFilter::nominal_interval() const { return interval_of(leader().filter); }

double MultipleModelFilter::sigma() const { return sigma_of(leader().filter); }

bool MultipleModelFilter::start(const Vector& z, const Matrix& covariance) {
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

bool MultipleModelFilter::predict(double dt) {
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

bool MultipleModelFilter::update(const Vector& z, const Matrix& covariance) {
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

bool MultipleModelFilter::update(const Vector& z) {
  return update(z, sigma() * sigma() * Matrix::Identity());
}

void MultipleModelFilter::coast() {
  for (Model& model : models_) std::visit([](auto& f) { f.coast(); }, model.filter);
}

bool MultipleModelFilter::is_started() const {
  return std::visit([](const auto& f) { return f.is_started(); }, leader().filter);
}

int MultipleModelFilter::updates() const {
  return std::visit([](const auto& f) { return f.updates(); }, leader().filter);
}

int MultipleModelFilter::consecutive_misses() const {
  return std::visit([](const auto& f) { return f.consecutive_misses(); }, leader().filter);
}

const Kinematics<2>& MultipleModelFilter::prior() const {
  return std::visit([](const auto& f) -> const Kinematics<2>& { return f.prior(); },
                    leader().filter);
}

const Kinematics<2>& MultipleModelFilter::estimate() const { return estimate_of(leader().filter); }

const std::optional<Eigen::Vector2d>& MultipleModelFilter::residual() const {
  return std::visit([](const auto& f) -> const std::optional<Vector>& { return f.residual(); },
                    leader().filter);
}

Eigen::Vector2d MultipleModelFilter::noise_sigma() const {
  if (const auto* gains = std::get_if<GainFilter<2>>(&leader().filter)) {
    return gains->noise_sigma();
  }
  return std::visit([](const auto& f) -> Vector { return f.position_sigma(); }, leader().filter);
}

Eigen::Matrix2d MultipleModelFilter::innovation_covariance() const {
  return innovation_covariance(sigma() * sigma() * Matrix::Identity());
}

Eigen::Matrix2d MultipleModelFilter::covariance() const {
  Matrix sum = Matrix::Zero();
  for (const Model& model : models_) {
    const Vector d = estimate_of(model.filter).position - estimate().position;
    sum += model.weight *
           (innovation_covariance_of(model.filter, Matrix::Zero()) + Matrix(d * d.transpose()));
  }
  return sum;
}

/// Weight that a model gets from those that the target gives up.
double MultipleModelFilter::arriving(const Model& model, double leaving) const {
  if (models_.size() == 1) return 0.0;
  return leaving * (1.0 - model.weight) / static_cast<double>(models_.size() - 1);
}

/// The largest variance that a model takes the position to have.
double MultipleModelFilter::widest_variance() const {
  double widest = 0.0;
  for (const Model& model : models_) {
    widest = std::max(widest, innovation_covariance_of(model.filter, Matrix::Zero()).trace());
  }
  return widest;
}

void MultipleModelFilter::follow_the_leader() {
  const Knowledge<2> known =
      std::visit([](const auto& f) { return f.knowledge(); }, leader().filter);
  const double left = chain_.has_left();
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const Model& model = models_[i];
    if (i == leader_ || arriving(model, left) <= staying(model, left)) continue;
    std::visit([&](auto& f) { f.adopt(known); }, models_[i].filter);
  }
}

void MultipleModelFilter::share_weights() {
  for (Model& model : models_) model.weight = 1.0 / static_cast<double>(models_.size());
}

std::vector<double> MultipleModelFilter::weights_after(const Vector& z,
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
void MultipleModelFilter::elect() {
  for (std::size_t i = 0; i < models_.size(); ++i) {
    if (models_[i].weight > models_[leader_].weight) leader_ = i;
  }
}

}  // namespace ghtrack

#include "tracker/filters/discrete_bayes_filter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/portable_math.hpp"

namespace ghtrack {

using discrete_bayes::Belief;

DiscreteBayesFilter::DiscreteBayesFilter(const DiscreteBayesConfig& config)
    : config_(config),
      kernel_(discrete_bayes::normalized(config.kernel)),
      belief_(discrete_bayes::normalized(Belief(
          config.map.empty() ? static_cast<std::size_t>(config.cells) : config.map.size(), 1.0))) {}

double DiscreteBayesFilter::expected_at(std::size_t cell) const {
  return config_.map.empty() ? static_cast<double>(cell) : config_.map[cell];
}

double DiscreteBayesFilter::likelihood(std::size_t cell, double z) const {
  if (!config_.map.empty()) {
    return z == config_.map[cell] ? config_.accuracy : 1.0 - config_.accuracy;
  }
  double error = z - static_cast<double>(cell);
  if (config_.ring) error = std::remainder(error, static_cast<double>(belief_.size()));
  const double sigmas = error / config_.noise;
  return portable::exp(-0.5 * sigmas * sigmas);
}

bool DiscreteBayesFilter::start(const Vector& z) {
  belief_ = discrete_bayes::normalized(Belief(belief_.size(), 1.0));
  const bool used = update(z);
  prior_ = estimate_;
  residual_.reset();
  return used;
}

bool DiscreteBayesFilter::predict(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    ++refusals_.times;
    return false;
  }
  const auto edge = config_.ring ? discrete_bayes::Edge::kWrap : discrete_bayes::Edge::kConstant;
  const Belief moved = discrete_bayes::predicted(belief_, config_.movement, kernel_, edge);
  const bool is_gone = std::all_of(moved.begin(), moved.end(), [](double p) { return !(p > 0.0); });
  if (is_gone) {
    ++refusals_.times;
    return false;
  }
  belief_ = discrete_bayes::normalized(moved);
  choose();
  prior_ = estimate_;
  residual_.reset();
  return true;
}

bool DiscreteBayesFilter::update(const Vector& z) {
  Belief likelihoods(belief_.size());
  double total = 0.0;
  for (std::size_t cell = 0; cell < belief_.size(); ++cell) {
    likelihoods[cell] = likelihood(cell, z[0]);
    total += likelihoods[cell] * belief_[cell];
  }
  if (!(total > 0.0) || !std::isfinite(z[0])) {
    ++refusals_.measurements;
    return false;
  }
  double residual = z[0] - expected_at(likeliest_);
  if (config_.map.empty() && config_.ring) {
    residual = std::remainder(residual, static_cast<double>(belief_.size()));
  }
  residual_ = Vector(residual);
  belief_ = discrete_bayes::updated(likelihoods, belief_);
  prior_ = estimate_;
  choose();
  return true;
}

void DiscreteBayesFilter::choose() {
  likeliest_ =
      static_cast<std::size_t>(std::max_element(belief_.begin(), belief_.end()) - belief_.begin());
  estimate_.position[0] = static_cast<double>(likeliest_);
}

}  // namespace ghtrack

#include "tracker/filters/discrete_bayes.hpp"

#include <cmath>
#include <stdexcept>

namespace ghtrack::discrete_bayes {
namespace {

/// A row with what lies beyond its ends.
class Row {
 public:
  Row(std::span<const double> cells, Edge edge, double beyond)
      : cells_(cells), edge_(edge), beyond_(beyond) {}

  double operator[](std::ptrdiff_t i) const {
    const auto size = std::ssize(cells_);
    if (edge_ == Edge::kWrap) return cells_[static_cast<std::size_t>(((i % size) + size) % size)];
    return i >= 0 && i < size ? cells_[static_cast<std::size_t>(i)] : beyond_;
  }

 private:
  std::span<const double> cells_;
  Edge edge_;
  double beyond_;
};

}  // namespace

Belief normalized(std::span<const double> weights) {
  double total = 0.0;
  for (const double weight : weights) {
    if (!(weight >= 0.0)) throw std::invalid_argument("a probability is negative or not a number");
    total += weight;
  }
  if (!(total > 0.0) || !std::isfinite(total)) {
    throw std::invalid_argument("the probabilities must have a positive, finite sum");
  }
  Belief belief(weights.begin(), weights.end());
  for (double& cell : belief) cell /= total;
  return belief;
}

Belief predicted(std::span<const double> belief, int offset, std::span<const double> kernel,
                 Edge edge, double beyond) {
  if (belief.empty()) throw std::invalid_argument("the belief has no cells");
  if (kernel.empty()) throw std::invalid_argument("the kernel has no elements");
  const Row before(belief, edge, beyond);
  Belief moved(belief.size());
  for (std::ptrdiff_t i = 0; i < std::ssize(moved); ++i) {
    moved[static_cast<std::size_t>(i)] = before[i - offset];
  }
  const Row shifted(moved, edge, beyond);
  const std::ptrdiff_t centre = std::ssize(kernel) / 2;
  Belief spread(belief.size(), 0.0);
  for (std::ptrdiff_t i = 0; i < std::ssize(spread); ++i) {
    for (std::ptrdiff_t j = 0; j < std::ssize(kernel); ++j) {
      spread[static_cast<std::size_t>(i)] +=
          kernel[static_cast<std::size_t>(j)] * shifted[i + centre - j];
    }
  }
  return spread;
}

Belief updated(std::span<const double> likelihood, std::span<const double> prior) {
  if (likelihood.size() != prior.size()) {
    throw std::invalid_argument("likelihood and prior must have the same number of cells");
  }
  Belief products(prior.begin(), prior.end());
  for (std::size_t i = 0; i < products.size(); ++i) products[i] *= likelihood[i];
  return normalized(products);
}

}  // namespace ghtrack::discrete_bayes

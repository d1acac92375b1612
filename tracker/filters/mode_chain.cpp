#include "tracker/filters/mode_chain.hpp"

#include <cmath>
#include <stdexcept>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kSame = 1e-6;     // relative; times are rounded
constexpr double kPatience = 3.0;  // nominal intervals

}  // namespace

ModeChain::ModeChain(std::size_t modes, double switching, double interval, double sigma, int axes)
    : modes_(static_cast<double>(modes)),
      switching_(switching),
      interval_(interval),
      nominal_((axes + kSame) * sigma * sigma),
      variance_(nominal_),
      has_left_(switching) {
  if (modes == 0) throw std::invalid_argument("several models need at least one filter");
  if (!(switching >= 0.0 && switching <= 0.5)) {
    throw std::invalid_argument("the probability of changing the model must lie in [0, 0.5]");
  }
}

void ModeChain::start(double variance) {
  elapsed_ = waiting_ = 0.0;
  variance_ = variance;
  has_left_ = switching_;
  is_due_ = true;
}

void ModeChain::update(double variance, double error) {
  has_left_ = leaving();
  waiting_ = is_due_ ? 0.0 : waiting_ + elapsed_;
  variance_ *= portable::pow(2.0, elapsed_ / (kPatience * interval_));
  is_due_ = error <= nominal_ || !(variance > variance_);
  if (is_due_) variance_ = variance;
  elapsed_ = 0.0;
}

/// The transition matrix to the power time / interval: all its other eigenvalues are equal.
double ModeChain::leaving() const {
  if (!is_due_ || modes_ == 1.0) return 0.0;
  const double steps = (waiting_ + elapsed_) / interval_;
  if (std::abs(steps - 1.0) <= kSame) return switching_;
  const double others = (modes_ - 1.0) / modes_;
  return others * (1.0 - portable::pow(1.0 - switching_ / others, steps));
}

}  // namespace ghtrack
